"""BVH: a skeleton as text, read, sampled and posed as any other."""

import io

import numpy as np
import pytest

from caesura.core.errors import BrokenContainer, CaesuraError, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.bvh.hierarchy import read_bvh_header
from caesura.formats.upload_summary import HeaderTake, read_header
from tests.formats.opening import codes, opened

ARM = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Upper arm
  {
    OFFSET 0 1 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 2 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.0083333
0 0 0 0 0 0 0 0 0
1 2 3 90 0 0 0 0 0
0 0 0 0 0 0 90 90 0
"""


def test_joints_are_where_their_channels_put_them() -> None:
    """Rotations in the order of the file, in degrees; a place of the root stands for its offset."""
    arm = opened(ARM.encode())
    assert (arm.vertex_count, len(arm.triangles), arm.frames, arm.frame_rate) == (3, 0, 3, 120.0)
    assert codes(arm) == {"skeleton-only"}
    expected = [
        [[0, 0, 0], [0, 1, 0], [0, 3, 0]],
        [[1, 2, 3], [0, 2, 3], [-2, 2, 3]],
        [[0, 0, 0], [0, 1, 0], [0, 1, 2]],  # Z · X: the end is first turned about X, to +z, where Z leaves it
    ]
    np.testing.assert_allclose(arm.vertices(0, 3), expected, atol=1e-5)
    assert arm.gltf is not None


def test_several_roots_below_one_without_channels() -> None:
    """As Blender writes them: that root never moves, and is no joint of the figure."""
    roots = "".join(
        f"JOINT j{i} {{ OFFSET {i} 0 0 CHANNELS 6 Xposition Yposition Zposition Xrotation Yrotation Zrotation"
        " End Site { OFFSET 0 1 0 } } "
        for i in range(2)
    )
    text = f"HIERARCHY\nROOT __0\n{{\nOFFSET 0.0 0.0 0.0\nCHANNELS 0\n{roots}\n}}\nMOTION\nFrames: 2\n"
    text += "Frame Time: 0.033333\n5 0 0 0 0 0 7 0 0 0 0 0\n5 1 0 0 0 0 7 0 0 0 0 90\n"
    drawn = opened(text.encode()).vertices(0, 2)
    np.testing.assert_allclose(drawn[0], [[5, 0, 0], [5, 1, 0], [7, 0, 0], [7, 1, 0]], atol=1e-6)
    np.testing.assert_allclose(drawn[1], [[5, 1, 0], [5, 2, 0], [7, 0, 0], [6, 0, 0]], atol=1e-6)


def test_rotations_are_products_of_matrices() -> None:
    """Any order of channels: R = R1 · R2 · R3."""
    angles = np.random.default_rng(0).uniform(-180, 180, (20, 3))
    rows = "\n".join("0 0 0 0 0 0 " + " ".join(map(str, row)) for row in angles)
    text = ARM.split("0 0 0 0 0 0 0 0 0", maxsplit=1)[0].replace("Frames: 3", "Frames: 20") + rows
    drawn = opened(text.encode()).vertices(0, 20)
    z, x, y = np.radians(angles).T

    def about(axis: int, angle: float) -> np.ndarray:
        a, b = [(1, 2), (2, 0), (0, 1)][axis]
        matrix = np.eye(3)
        matrix[[a, a, b, b], [a, b, a, b]] = [np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)]
        return matrix

    for i in range(20):
        end = about(2, z[i]) @ about(0, x[i]) @ about(1, y[i]) @ [0, 2, 0] + [0, 1, 0]
        np.testing.assert_allclose(drawn[i, 2], end, atol=1e-5)


def test_the_header_tells_joints_and_frames() -> None:
    """Without reading a number of the motion."""
    header = read_header(io.BytesIO(ARM.encode()), "arm.bvh", Limits())
    (take,) = header.takes
    assert (header.format, header.vertices, header.triangles) == ("bvh", 3, 0)
    assert take == HeaderTake(0, "motion", pytest.approx(2 / 120, rel=1e-4), 3, 120.0)


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("MOTION", "", "malformed-bvh"),
        ("Frames: 3", "Frames: 4", "malformed-bvh"),
        ("Frames: 3", "Frames: many", "malformed-bvh"),
        ("Frames: 3", "Frames: -3", "malformed-bvh"),
        ("Frames: 3", "Frames: 1e300", "malformed-bvh"),
        ("Frames: 3", "Frames: 0", "no-motion"),
        ("Frames: 3", "Frames: 999999999", "animation-too-long"),
        ("0.0083333", "0", "malformed-bvh"),
        ("0.0083333", "nan", "malformed-bvh"),
        ("0.0083333", "", "malformed-bvh"),
        ("OFFSET 0 2 0", "OFFSET 0 x 0", "malformed-bvh"),
        ("OFFSET 0 2 0", "OFFSET 0 inf 0", "malformed-bvh"),
        ("CHANNELS 3", "CHANNELS 99999999999", "malformed-bvh"),
        ("CHANNELS 3", "CHANNELS -1", "malformed-bvh"),
        ("CHANNELS 3", "CHANNELS 0", "malformed-bvh"),
        ("CHANNELS 3", "CHANNELS", "malformed-bvh"),
        ("CHANNELS 6", "CHANNELS \u00b2", "malformed-bvh"),
        ("Zrotation", "Wrotation", "malformed-bvh"),
        ("JOINT Upper arm\n  {", "JOINT Upper arm", "malformed-bvh"),
        ("90 90 0", "90 ninety 0", "malformed-bvh"),
        ("90 90 0", "90 nan 0", "non-finite-data"),
        ("90 90 0", "90 1e300 0", "non-finite-data"),
        ("}\nMOTION", "MOTION", "malformed-bvh"),
        ("}\nMOTION", "} } }\nMOTION", "malformed-bvh"),
    ],
)
def test_broken_text_is_refused(old: str, new: str, code: str) -> None:
    """With a sentence that says where it breaks off."""
    with pytest.raises(CaesuraError) as refused:
        opened(ARM.replace(old, new).encode())
    assert refused.value.code == code
    assert isinstance(refused.value, BrokenContainer | InvalidModel | LimitExceeded)


def test_a_deep_chain_is_read() -> None:
    """Deep is not wrong; more joints than the service takes are refused."""
    depth = 2_000
    joints = "".join(f"JOINT j{i} {{ OFFSET 0 1 0 CHANNELS 1 Zrotation " for i in range(depth))
    text = f"HIERARCHY ROOT r {{ OFFSET 0 0 0 {joints}{'} ' * depth}}}\nMOTION\nFrames: 2\nFrame Time: 0.04\n"
    text += " ".join(["0"] * depth * 2)
    assert opened(text.encode()).vertices(0, 1)[0, -1].tolist() == [0, depth, 0]
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_NODES"):
        opened(text.encode(), Limits(max_nodes=100))


def test_a_long_take_keeps_its_clock() -> None:
    """A frame's time is rounded in the file; its thousands of frames are still one each."""
    rows = "\n".join(f"{i} 0 0 0 0 0 0 0 0" for i in range(5_000))
    text = ARM.split("0 0 0 0 0 0 0 0 0", maxsplit=1)[0].replace("Frames: 3", "Frames: 5000") + rows
    arm = opened(text.encode())
    assert arm.frames == 5_000
    np.testing.assert_allclose(arm.vertices(0, 5_000)[:, 0, 0], np.arange(5_000), atol=1e-2)


def test_a_long_name_is_refused_and_never_copied() -> None:
    """A million letters, and ends that would each take them: refused before any joint is kept."""
    bomb = (
        "HIERARCHY ROOT "
        + "x" * 1_000_000
        + " {"
        + " End Site { OFFSET 0 0 0 }" * 400
        + " }\n"
        + ARM[ARM.index("MOTION") :]
    )
    with pytest.raises(BrokenContainer, match="letters") as refused:
        opened(bomb.encode())
    assert refused.value.code == "malformed-bvh"
    assert len(str(refused.value)) < 300


def test_ends_below_ends_do_not_grow_their_names() -> None:
    """A hierarchy that begins with an end, or nests a thousand of them, has names as short as any."""
    depth = 1000
    nested = "HIERARCHY ROOT Hips { OFFSET 0 0 0 CHANNELS 1 Zrotation"
    nested += " End Site { OFFSET 0 1 0" * depth + " }" * (depth + 1) + "\nMOTION\nFrames: 2\nFrame Time: 0.04\n0\n9\n"
    head = read_bvh_header(nested.encode(), Limits())
    assert max(len(joint.name) for joint in head.joints) == len("Hips end")
    first = nested.replace("ROOT Hips { OFFSET 0 0 0 CHANNELS 1 Zrotation", "").replace(
        " }" * (depth + 1), " }" * depth
    )
    assert read_bvh_header(first.encode(), Limits()).joints[0].name == " end"


def test_joints_of_several_orders_are_turned_together_or_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Twenty joints of two orders of channels: the same vertices whether many or one of them are computed at a time."""
    orders = ("Zrotation Xrotation Yrotation", "Yrotation Zrotation Xrotation")
    lines = ["HIERARCHY", "ROOT r", "{", "OFFSET 0 0 0", f"CHANNELS 3 {orders[0]}"]
    for i in range(19):
        lines += [f"JOINT j{i}", "{", "OFFSET 0 1 0", f"CHANNELS 3 {orders[i % 2]}"]
    angles = np.random.default_rng(0).uniform(-90, 90, (5, 60))
    lines += ["}"] * 20 + ["MOTION", "Frames: 5", "Frame Time: 0.04", *(" ".join(map(str, row)) for row in angles)]
    data = "\n".join(lines).encode()
    together = opened(data).vertices(0, 5)
    monkeypatch.setattr("caesura.formats.bvh.gltf_conversion.AT_ONCE", 1)
    np.testing.assert_array_equal(opened(data).vertices(0, 5), together)
    turned = data.replace(orders[1].encode(), orders[0].encode())
    assert np.abs(opened(turned).vertices(0, 5) - together).max() > 0.1
