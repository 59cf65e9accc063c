"""Hostile archives: one fault each, and the code it is refused with."""

import io
import json
import pickle
import struct
import zipfile
from typing import Any

import numpy as np
import pytest

from caesura.core.errors import CaesuraError, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from tests.formats.opening import opened
from tests.formats.test_npz import FRAMES, TRIANGLES, npz


def npy(array: Any) -> bytes:
    out = io.BytesIO()
    np.save(out, array)
    return out.getvalue()


def npy_saying(header: str, data: bytes = b"", version: int = 1) -> bytes:
    text = header.encode("latin1")
    return b"\x93NUMPY" + bytes([version, 0]) + struct.pack("<H" if version == 1 else "<I", len(text)) + text + data


def zipped(members: dict[str, bytes] | list[tuple[str, bytes]], method: int = zipfile.ZIP_STORED) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as archive:
        for name, data in members.items() if isinstance(members, dict) else members:
            archive.writestr(name, data)
    return out.getvalue()


def with_vertices(member: bytes) -> bytes:
    return zipped({"vertices.npy": member, "triangles.npy": npy(TRIANGLES)})


def saying(shape: str, dtype: str = "'<f4'", data: bytes = b"") -> bytes:
    return with_vertices(npy_saying(f"{{'descr': {dtype}, 'fortran_order': False, 'shape': {shape}}}", data))


class _Bomb:
    def __reduce__(self) -> tuple[Any, ...]:
        return (pytest.fail, ("code in the file has run",))


def patched(data: bytes, place: int, value: bytes) -> bytes:
    return data[:place] + value + data[place + len(value) :]


GOOD = npz()
DEFLATED = npz(deflate=True)
DIRECTORY = GOOD.index(b"PK\1\2")
NAN = FRAMES.copy()
NAN[4, 2, 1] = np.nan

POSES = np.ones((9, 72))
TRIANGLE_MINUS = TRIANGLES.copy()
TRIANGLE_MINUS[0, 0] = -1

FAULTS: list[tuple[str, bytes, str]] = [
    ("a zip of other things", zipped({"readme.txt": b"hello"}), "unsupported-media-type"),
    ("an empty zip", zipped({}), "unsupported-media-type"),
    ("cut off", GOOD[:-30], "malformed-npz"),
    ("cut to its first bytes", GOOD[:100], "malformed-npz"),
    ("directory only", GOOD[DIRECTORY:], "malformed-npz"),
    ("17 members", zipped({f"a{i}.npy": npy(TRIANGLES) for i in range(17)}), "malformed-npz"),
    ("50,000 members", zipped({f"a{i}.npy": b"" for i in range(50_000)}), "malformed-npz"),
    ("a path as a name", zipped({"../vertices.npy": npy(FRAMES), "triangles.npy": npy(TRIANGLES)}), "malformed-npz"),
    ("encrypted", patched(GOOD, DIRECTORY + 8, b"\1\0"), "malformed-npz"),
    ("bzip2", zipped({"vertices.npy": npy(FRAMES)}, zipfile.ZIP_BZIP2), "malformed-npz"),
    ("a stored byte changed", patched(GOOD, GOOD.index(FRAMES.tobytes()), b"\0"), "malformed-npz"),
    ("a deflated byte changed", patched(DEFLATED, 200, b"\xff\xff\xff"), "malformed-npz"),
    ("no NumPy array", with_vertices(b"not an array at all"), "malformed-npz"),
    ("cut within a header", with_vertices(npy(FRAMES)[:40]), "malformed-npz"),
    ("header of 4 GB", with_vertices(b"\x93NUMPY\2\0\xff\xff\xff\xff"), "malformed-npz"),
    ("expression in a header", saying("(__import__('os').getpid(), 3, 3)"), "malformed-npz"),
    ("deep header", saying("(" * 4000 + ")" * 4000), "malformed-npz"),
    ("shape 10^12", saying("(10**12, 5, 3)"), "malformed-npz"),
    ("shape a trillion", saying("(1000000000000, 5, 3)"), "malformed-npz"),
    ("shape negative", saying("(-9, 5, 3)"), "malformed-npz"),
    ("shape of booleans", saying("(True, 5, 3)"), "malformed-npz"),
    ("shape too small for its data", saying("(2, 5, 3)", data=FRAMES.tobytes()), "malformed-npz"),
    ("header of other keys", with_vertices(npy_saying("{'descr': '<f4'}")), "malformed-npz"),
    ("pickled", with_vertices(npy_saying("{'descr': '|O', 'fortran_order': False, 'shape': (9, 5, 3)}",
                                         pickle.dumps(_Bomb()))), "unsupported-dtype"),
    ("structured", saying("(9, 5, 3)", "[('x', '<f4')]"), "unsupported-dtype"),
    ("long double", npz(vertices=FRAMES.astype("g")), "unsupported-dtype"),
    ("complex", npz(vertices=FRAMES.astype("c8")), "unsupported-dtype"),
    ("booleans", npz(triangles=TRIANGLES > 0), "unsupported-dtype"),
    ("text", npz(triangles=TRIANGLES.astype(str)), "unsupported-dtype"),
    ("half triangles", npz(triangles=TRIANGLES + 0.5), "unsupported-dtype"),
    ("NaN triangles", npz(triangles=TRIANGLES * np.nan), "unsupported-dtype"),
    ("negative triangle", npz(triangles=TRIANGLE_MINUS), "index-out-of-range"),
    ("triangle out of range", npz(triangles=TRIANGLES + 1), "index-out-of-range"),
    ("triangle 2^63", npz(triangles=np.full((1, 3), 2**63, np.uint64)), "index-out-of-range"),
    ("(F, 3, V)", npz(vertices=FRAMES.transpose(0, 2, 1)), "wrong-shape"),
    ("(V, 3)", npz(vertices=FRAMES[0]), "wrong-shape"),
    ("quads", npz(triangles=np.zeros((2, 4), int)), "wrong-shape"),
    ("no vertices at all", npz(vertices=FRAMES[:, :0]), "wrong-shape"),
    ("no triangles at all", npz(triangles=TRIANGLES[:0]), "wrong-shape"),
    ("no frames", npz(vertices=FRAMES[:0]), "no-motion"),
    ("rest of other vertices", npz(rest=FRAMES[0, :4]), "wrong-shape"),
    ("triangles missing", zipped({"vertices.npy": npy(FRAMES)}), "wrong-shape"),
    ("vertices missing", zipped({"triangles.npy": npy(TRIANGLES)}), "wrong-shape"),
    ("a frame an array", zipped({f"frame{i}.npy": npy(FRAMES[i]) for i in range(2)}), "varying-topology"),
    ("a body model", zipped({"body_pose.npy": npy(FRAMES), "betas.npy": npy(FRAMES)}), "body-model-parameters"),
    ("poses of five joints", zipped({"poses.npy": npy(FRAMES), "betas.npy": npy(FRAMES)}), "wrong-shape"),
    ("poses of 73 numbers", zipped({"poses.npy": npy(np.zeros((9, 73)))}), "wrong-shape"),
    ("poses of 24 joints in the plane", zipped({"poses.npy": npy(np.zeros((9, 36, 2)))}), "wrong-shape"),
    ("one number as poses", zipped({"poses.npy": npy(np.float64(3))}), "wrong-shape"),
    ("no poses", zipped({"poses.npy": npy(POSES[:0])}), "no-motion"),
    ("poses with NaN", zipped({"poses.npy": npy(POSES * np.nan)}), "non-finite-data"),
    ("poses beyond all angles", zipped({"poses.npy": npy(POSES * 1e39)}), "non-finite-data"),
    ("places of other frames", zipped({"poses.npy": npy(POSES), "trans.npy": npy(POSES[:8, :3])}), "wrong-shape"),
    ("places beyond all bounds", zipped({"poses.npy": npy(POSES), "trans.npy": npy(POSES[:, :3] * 1e39)}),
     "non-finite-data"),
    ("poses without end", zipped({"poses.npy": npy(POSES), "fps.npy": npy(np.float64(5e-324))}), "animation-too-long"),
    ("poses at no rate", zipped({"poses.npy": npy(POSES), "mocap_framerate.npy": npy(np.float64(0))}),
     "invalid-frame-rate"),
    ("NaN rest", npz(rest=NAN[4]), "non-finite-data"),
    ("rate 0", npz(frame_rate=0), "invalid-frame-rate"),
    ("rate NaN", npz(fps=np.nan), "invalid-frame-rate"),
    ("rate so low that its take has no end", npz(frame_rate=5e-324), "animation-too-long"),
    ("years at 1e-9 a second", npz(frame_rate=1e-9), "animation-too-long"),
]  # fmt: skip


@pytest.mark.parametrize(("data", "code"), [pytest.param(data, code, id=name) for name, data, code in FAULTS])
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_hostile_archive_is_refused_by_name(data: bytes, code: str) -> None:
    """An error of ours, with its code; nothing in the file runs, and nobody is told how to make it run."""
    with pytest.raises(CaesuraError) as refused:
        opened(data)
    assert refused.value.code == code
    assert "pickle" not in refused.value.detail
    json.dumps(refused.value.problem()).encode()


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_name_twice_is_refused() -> None:
    """Two arrays of one name: nobody knows which is meant."""
    data = zipped([("vertices.npy", npy(FRAMES)), ("vertices.npy", npy(FRAMES)), ("triangles.npy", npy(TRIANGLES))])
    with pytest.raises(CaesuraError, match="twice"):
        opened(data)


def test_a_bomb_is_refused_before_it_is_inflated() -> None:
    """Zeros deflate a thousandfold: what counts is what they inflate to."""
    data = zipped({"vertices.npy": npy(np.zeros((900, 500, 3))), "triangles.npy": npy(TRIANGLES)}, zipfile.ZIP_DEFLATED)
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_INFLATED_BYTES"):
        opened(data, Limits(max_inflated_bytes=2**20))


def test_a_size_that_lies_is_found() -> None:
    """A member that inflates to more than its directory says is stopped there."""
    member = npy(FRAMES)
    data = zipped({"vertices.npy": member, "triangles.npy": npy(TRIANGLES)}, zipfile.ZIP_DEFLATED)
    directory = data.index(b"PK\1\2")
    small = npy_saying("{'descr': '<f4', 'fortran_order': False, 'shape': (9, 5, 3)}")
    assert len(small) < len(member)
    lying = patched(data, directory + 24, struct.pack("<I", len(member) - 4))
    with pytest.raises(CaesuraError) as refused:
        opened(lying)
    assert refused.value.code == "malformed-npz"


@pytest.mark.parametrize(
    ("limits", "setting"),
    [
        (Limits(max_vertices=4), "CAESURA_MAX_VERTICES"),
        (Limits(max_triangles=1), "CAESURA_MAX_TRIANGLES"),
        (Limits(max_frames=8), "CAESURA_MAX_FRAMES"),
        (Limits(max_seconds=0.1), "CAESURA_MAX_SECONDS"),
        (Limits(max_triangle_frames=17), "CAESURA_MAX_TRIANGLE_FRAMES"),
    ],
)
def test_a_sequence_that_is_too_large_is_refused_by_its_limit(limits: Limits, setting: str) -> None:
    """Each limit by its name."""
    with pytest.raises(LimitExceeded, match=setting + r"\."):
        opened(npz(), limits)


@pytest.mark.parametrize("fps", ["source", 45])
def test_numbers_that_are_not_finite_are_found_when_they_are_drawn(fps: object) -> None:
    """By frame and vertex, at whatever rate it is drawn."""
    animation = opened(npz(vertices=NAN, frame_rate=30), fps=fps)
    with pytest.raises(InvalidModel) as refused:
        animation.vertices(2, animation.frames)
    assert refused.value.code == "non-finite-data"
    assert refused.value.where["vertex"] == 2
    assert refused.value.where["frame"] == (4 if fps == "source" else 5)
