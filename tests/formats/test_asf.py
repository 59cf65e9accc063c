"""ASF and AMC: bones of one text, turned by the angles of another."""

import io
from pathlib import Path

import numpy as np
import pytest

from benchmarks.takes import acclaim
from caesura.core.errors import CaesuraError, InvalidModel, LimitExceeded, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.formats.upload_summary import HeaderTake, read_header
from tests.formats.opening import codes, opened
from tests.formats.test_zip import zipped

ASF = """# made by hand
:version 1.10
:name ARM
:units
  mass 1.0
  length 0.5
  angle deg
:documentation
  an arm that is no one's
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 10 20 30
:bonedata
  begin
    id 1
    name upper
    direction 1 0 0
    length 10
    axis 0 0 20 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
           (-60.0 70.0)
  end
  begin
    id 2
    name lower
    direction 0.6 0.8 0
    length 5
    axis -90 40 20 XYZ
    dof rz rx
  end
  begin
    id 3
    name other
    direction 0 1 0
    length 2
    axis 0 0 0 XYZ
  end
:hierarchy
  begin
    root upper other
    upper lower
  end
"""
FRAMES = 25
ANGLES = {
    name: np.random.default_rng(8).uniform(-170, 170, (FRAMES, n))
    for name, n in (("root", 6), ("upper", 3), ("lower", 2))
}


def amc(values: dict[str, np.ndarray] = ANGLES, head: str = ":FULLY-SPECIFIED\n:DEGREES\n", first: int = 1) -> bytes:
    """A motion of so many numbers a bone and frame."""
    lines = ["#!OML:ASF arm.asf", *head.splitlines()]
    for frame in range(len(next(iter(values.values())))):
        lines.append(str(first + frame))
        lines += [f"{name} " + " ".join(f"{x:.9g}" for x in rows[frame]) for name, rows in values.items()]
    return "\n".join(lines).encode() + b"\n"


def both(motion: bytes | None = None, skeleton: str = ASF) -> dict[str, bytes]:
    return {"arm.amc": motion or amc(), "arm.asf": skeleton.encode()}


def twin_places(asf: str, motion: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Where bones start, and where those end that no bone follows, by matrices."""
    skeleton = acclaim.read_skeleton(asf)
    values = acclaim.read_motion(motion.decode())
    frames = len(next(iter(values.values())))
    rotations, starts = skeleton.pose(values, frames)
    leaves = sorted(set(range(len(skeleton.bones))) - {bone.parent for bone in skeleton.bones})
    ends = [starts[:, i] + rotations[:, i] @ skeleton.bones[i].vector for i in leaves]
    return starts, np.stack(ends, axis=1)


def assert_same_places(drawn: np.ndarray, starts: np.ndarray, ends: np.ndarray, atol: float) -> None:
    """The same places in any order: that of the figure is depth first."""
    expected = np.concatenate([starts, ends], axis=1)
    distance = np.abs(drawn[:, :, None] - expected[:, None]).max(axis=3).max(axis=0)
    assert len(drawn[0]) == len(expected[0])
    assert distance.min(axis=1).max() < atol
    assert distance.min(axis=0).max() < atol


def test_bones_are_where_their_angles_put_them() -> None:
    """By a reader that multiplies matrices: axes at rest, freedoms in any order, a root that is turned and moved."""
    arm = opened(both())
    assert (arm.frames, arm.frame_rate, arm.vertex_count) == (FRAMES, 120.0, 4 + 2)
    assert codes(arm) == {"frame-rate-assumed", "skeleton-only"}
    assert_same_places(arm.vertices(0, FRAMES), *twin_places(ASF, amc()), atol=1e-4)


def test_lengths_are_metres() -> None:
    """A length of 10 in units of half an inch is 20 inches."""
    still = {name: np.zeros_like(values) for name, values in ANGLES.items()}
    arm = opened(both(amc(still)))
    longest = np.linalg.norm(arm.vertices(0, 1)[0], axis=1)
    assert longest.max() == pytest.approx(np.hypot(10 + 3, 4) * 2 * 0.0254, rel=1e-5)


def test_degrees_and_radians_are_told_by_either_text() -> None:
    """The motion's word is believed, and where it has none the skeleton's."""
    turned = {
        name: np.concatenate([v[:, :3], np.radians(v[:, 3:])], axis=1) if name == "root" else np.radians(v)
        for name, v in ANGLES.items()
    }
    expected = opened(both()).vertices(0, FRAMES)
    radians = opened(both(amc(turned, ":RADIANS\n"))).vertices(0, FRAMES)
    np.testing.assert_allclose(radians, expected, atol=1e-4)
    asf = ASF.replace("angle deg", "angle rad")
    for degrees in ("10 20 30", "0 0 20", "-90 40 20"):
        asf = asf.replace(degrees, " ".join(f"{np.radians(float(x)):.12f}" for x in degrees.split()))
    silent = opened(both(amc(turned, ":FULLY-SPECIFIED\n"), asf)).vertices(0, FRAMES)
    np.testing.assert_allclose(silent, expected, atol=1e-4)


def test_an_amc_may_say_its_rate_and_begin_at_any_frame() -> None:
    """Frames count from 0 here."""
    arm = opened(both(amc(head=":FULLY-SPECIFIED\n:SAMPLES-PER-SECOND 60\n:DEGREES\n", first=1001)))
    assert (arm.frames, arm.frame_rate, codes(arm)) == (FRAMES, 60, {"skeleton-only"})


def test_both_lie_in_a_zip_too() -> None:
    """The one that is called like the motion; alone a motion says what it needs, and a skeleton what it is."""
    files = {"a/arm.amc": amc(), "a/Arm.ASF": ASF.encode(), "a/other.asf": b":version 1.1\n"}
    np.testing.assert_array_equal(opened(zipped(files)).vertices(0, 9), opened(both()).vertices(0, 9))
    with pytest.raises(InvalidModel, match=r"\.asf that holds its skeleton") as refused:
        opened(amc())
    assert refused.value.code == "missing-companion"
    for skeleton in (ASF, ASF.replace("# made by hand\n", ""), "# AST/ASF file\n" + ASF):
        with pytest.raises(UnsupportedMedia, match=r"with its AMC|not known"):
            opened(skeleton.encode())


def test_the_header_tells_frames_by_their_numbers() -> None:
    """The first and the last; the joints are in the other file."""
    header = read_header(io.BytesIO(amc(first=51)), "arm.amc", Limits())
    assert (header.format, header.vertices, header.triangles) == ("amc", None, 0)
    assert header.takes == (HeaderTake(0, "motion", pytest.approx(24 / 120), FRAMES, 120.0),)


def test_a_bone_that_stretches_is_turned_and_no_more() -> None:
    """Said, and its number passed over."""
    arm = opened(both(amc(ANGLES | {"lower": np.ones((FRAMES, 3))}), ASF.replace("dof rz rx", "dof rz rx l")))
    assert "freedoms-ignored" in codes(arm)


def test_long_texts_are_read_in_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same numbers, wherever a piece ends."""
    whole = opened(both()).vertices(0, FRAMES)
    for size in (300, 311, 1024):
        monkeypatch.setattr("caesura.formats.asf.motion.PIECE", size)
        np.testing.assert_array_equal(opened(both()).vertices(0, FRAMES), whole)


BROKEN_MOTIONS = {
    "of a number that is none": (b"\nupper ", b"\nupper x", "malformed-amc"),
    "of a value too many": (b"\n7\n", b"\n7 5\n", "malformed-amc"),
    "of a bone that comes twice": (b"\nlower ", b"\nlower\nlower ", "malformed-amc"),
    "that leaves a frame out": (b"\n7\n", b"\n8\n", "malformed-amc"),
    "of another bone": (b"lower", b"elbow", "unmatched-skeleton"),
    "that calls a bone otherwise once": (b"\n7\nroot", b"\n7\nRoot", "malformed-amc"),
    "of NaN": (b"\n7\nroot ", b"\n7\nroot nan ", "malformed-amc"),
    "of samples at no rate": (b":DEGREES", b":SAMPLES-PER-SECOND 0", "malformed-amc"),
    "of samples at two points": (b":DEGREES", b":SAMPLES-PER-SECOND 1.2.3", "malformed-amc"),
}


@pytest.mark.parametrize("fault", BROKEN_MOTIONS)
def test_a_broken_motion_is_refused(fault: str) -> None:
    """With a sentence."""
    old, new, code = BROKEN_MOTIONS[fault]
    assert old in amc()
    with pytest.raises(CaesuraError) as refused:
        opened(both(amc().replace(old, new)))
    assert refused.value.code == code


def test_an_angle_without_end_is_refused_with_its_frame() -> None:
    """The first that is too large."""
    angles = ANGLES["lower"].copy()
    angles[17:, 1] = 1e300
    with pytest.raises(InvalidModel) as refused:
        opened(both(amc(ANGLES | {"lower": angles})))
    assert (refused.value.code, refused.value.where["frame"]) == ("non-finite-data", 17)


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("length 0.5", "length 0", "malformed-asf"),
        ("length 0.5", "length half", "malformed-asf"),
        ("direction 1 0 0", "direction 1 0", "malformed-asf"),
        ("direction 1 0 0", "direction 1 0 1e400", "malformed-asf"),
        ("axis 0 0 20 XYZ", "axis 0 0 20 XYY", "malformed-asf"),
        ("axis 0 0 20 XYZ", "axis 0 0 20", "malformed-asf"),
        ("dof rz rx", "dof rz rz", "malformed-asf"),
        ("dof rz rx", "dof rz rw", "malformed-asf"),
        ("dof rz rx", "dof rz", "unmatched-skeleton"),
        ("name lower", "name " + "x" * 300, "malformed-asf"),
        ("upper lower", "upper nobody", "malformed-asf"),
        ("upper lower", "upper upper", "malformed-asf"),
        ("root upper other", "lower upper other", "malformed-asf"),
        ("order TX", "order TV", "malformed-asf"),
    ],
)
def test_a_broken_skeleton_is_refused(old: str, new: str, code: str) -> None:
    """With a sentence that says which of the two texts is wrong."""
    assert old in ASF
    with pytest.raises(CaesuraError) as refused:
        opened(both(skeleton=ASF.replace(old, new)))
    assert refused.value.code == code


def test_limits_hold_for_both() -> None:
    """Bones of the skeleton, frames and bytes of the motion."""
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_NODES"):
        opened(both(), Limits(max_nodes=3))
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_FRAMES"):
        opened(both(), Limits(max_frames=FRAMES - 1))
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_DECODED_BYTES"):
        opened(both(), Limits(max_decoded_bytes=1000))


def test_a_real_session_is_where_matrices_put_it(shared: Path) -> None:
    """Trial 86_01 of CMU's library: every hundredth frame."""
    folder = shared / "data/cmu86"
    files = {name: (folder / name).read_bytes() for name in ("86.asf", "86_01.amc")}
    take = opened(files)
    assert (take.frames, take.frame_rate) == (4579, 120)
    starts, ends = twin_places(files["86.asf"].decode(), files["86_01.amc"])
    drawn = np.concatenate([take.vertices(frame, frame + 1) for frame in range(0, take.frames, 100)])
    assert_same_places(drawn, starts[::100], ends[::100], atol=2e-5)
