"""Which arrays of an archive are poses, judged by their headers alone. Light: no NumPy."""

import math

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.npy_header import NpyHeader
from caesura.formats.smpl.kinematic_tree import TREES

SPELLINGS = {
    "poses": ("poses",),
    "trans": ("trans",),
    "frame_rate": ("mocap_framerate", "mocap_frame_rate", "frame_rate", "fps"),
}


def find_pose_members(members: list[str]) -> dict[str, str]:
    """Which member is which array; empty where the archive has no poses."""
    found = {what: name for what, spellings in SPELLINGS.items() for name in spellings[::-1] if name in members}
    return found if "poses" in found else {}


def check_pose_shapes(headers: dict[str, NpyHeader], limits: Limits) -> int:
    """The number of joints; raises `wrong-shape`, `no-motion` or `LimitExceeded`."""
    shape = headers["poses"].shape
    frames = shape[0] if shape else 0
    numbers = math.prod(shape[1:])
    if len(shape) not in (2, 3) or (len(shape) == 3 and shape[2] != 3) or numbers % 3 or numbers // 3 not in TREES:
        expected = ", ".join(f"(F, {3 * joints})" for joints in TREES)
        raise InvalidModel(
            "wrong-shape",
            f"poses is {shape}; three numbers for each joint of SMPL, SMPL-H or SMPL-X are expected: {expected}.",
            pointer="/poses",
            got=str(shape),
            expected=expected,
        )
    if "trans" in headers and headers["trans"].shape != (frames, 3):
        got = str(headers["trans"].shape)
        raise InvalidModel(
            "wrong-shape",
            f"trans is {got}; ({frames}, 3) is expected.",
            pointer="/trans",
            got=got,
            expected=f"({frames}, 3)",
        )
    if frames == 0:
        raise InvalidModel("no-motion", "The file has no poses; a motion needs two.", pointer="/poses")
    limits.check("max_frames", frames, "Cut the take", "/poses")
    return numbers // 3
