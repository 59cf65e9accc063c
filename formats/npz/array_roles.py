"""Which arrays of an NPZ are what, judged by their headers alone. Light: no NumPy."""

import re

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.notices import Notices
from caesura.formats.npy_header import NpyHeader
from caesura.formats.smpl.pose_members import find_pose_members
from caesura.formats.zip.archive import ZipArchive

SPELLINGS = {
    "vertices": ("vertices", "verts"),
    "triangles": ("triangles", "faces"),
    "frame_rate": ("frame_rate", "fps"),
    "rest": ("rest",),
}
BODY_MODEL = {"poses", "betas", "trans", "body_pose", "global_orient"}
ONE_FRAME = re.compile(r"(frame|vertices|verts)_?\d+")


def find_body_poses(archive: ZipArchive) -> dict[str, str]:
    """Which member is which array of a body model's poses; empty where there are none, or vertices too."""
    members = _arrays(archive)
    return {} if set(SPELLINGS["vertices"]) & set(members) else find_pose_members(members)


def find_members_by_use(archive: ZipArchive, notices: Notices) -> dict[str, str]:
    """Which member is which array; raises where vertices or triangles are missing, saying what the file is instead."""
    members = _arrays(archive)
    found = {what: name for what, spellings in SPELLINGS.items() for name in spellings[::-1] if name in members}
    missing = [what for what in ("vertices", "triangles") if what not in found]
    if missing and BODY_MODEL & set(members):
        raise InvalidModel(
            "body-model-parameters",
            "The file holds parameters of a body model and neither `poses` nor a surface. Save the poses of all joints "
            "as `poses`, or run the model and save its vertices (F, V, 3) and faces (T, 3), with numpy.savez.",
        )
    if "vertices" in missing and any(ONE_FRAME.fullmatch(name) for name in members):
        raise InvalidModel(
            "varying-topology",
            "Every frame is an array of its own. All frames must have the same vertices, in one array (F, V, 3).",
        )
    if missing:
        raise InvalidModel(
            "wrong-shape",
            f"The file needs arrays `vertices` (F, V, 3) and `triangles` (T, 3); {missing[0]} is missing.",
            pointer=f"/{missing[0]}",
        )
    extra = [name for name in archive.members if name not in found.values()]
    if extra:
        notices.add("members-ignored", f"Not used: {', '.join(name[:40] for name in extra)}.")
    return found


def _arrays(archive: ZipArchive) -> list[str]:
    return [name for name, info in archive.members.items() if info.filename.endswith(".npy")]


def check_shapes(headers: dict[str, NpyHeader], names: dict[str, str], limits: Limits) -> None:
    """Raise `wrong-shape` or `no-motion` by the headers alone, and `LimitExceeded` before anything is read."""
    frames, vertices, three = (*headers["vertices"].shape, 0, 0, 0)[:3]
    expected = {"vertices": "(F, V, 3)", "triangles": "(T, 3)", "rest": f"({vertices}, 3)", "frame_rate": "()"}
    fits = {
        "vertices": len(headers["vertices"].shape) == 3 and three == 3 and vertices > 0,
        "triangles": len(headers["triangles"].shape) == 2 and headers["triangles"].shape[1] == 3,
        "rest": "rest" not in headers or headers["rest"].shape == (vertices, 3),
        "frame_rate": "frame_rate" not in headers or headers["frame_rate"].shape in ((), (1,)),
    }
    fits["triangles"] = fits["triangles"] and headers["triangles"].shape[0] > 0
    for what, header in headers.items():
        if not fits[what]:
            raise InvalidModel(
                "wrong-shape",
                f"{names[what]} is {header.shape}; {expected[what]} is expected, none of them 0.",
                pointer=f"/{names[what]}",
                got=str(header.shape),
                expected=expected[what],
            )
    if frames == 0:
        raise InvalidModel("no-motion", "The sequence has no frames; a motion needs two.", pointer="/vertices")
    limits.check("max_vertices", vertices, pointer="/vertices")
    limits.check("max_triangles", headers["triangles"].shape[0], pointer="/triangles")
