"""Poses of SMPL bodies: a skeleton of the published tree, turned as the file says."""

import io
from typing import Any

import numpy as np
import pytest

from caesura.core.errors import LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.smpl.kinematic_tree import TREES
from caesura.formats.upload_summary import HeaderTake, read_header
from tests.formats.opening import codes, opened

FRAMES = 30
DRAW = np.random.default_rng(5)
READ = {"bone-lengths-assumed", "skeleton-only"}

SMPL = [-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19, 20, 21]
SMPL_H = [
    *SMPL[:22],
    *(20, 22, 23, 20, 25, 26, 20, 28, 29, 20, 31, 32, 20, 34, 35),
    *(21, 37, 38, 21, 40, 41, 21, 43, 44, 21, 46, 47, 21, 49, 50),
]
SMPL_X = [
    *SMPL[:22],
    *(15, 15, 15),
    *(20, 25, 26, 20, 28, 29, 20, 31, 32, 20, 34, 35, 20, 37, 38),
    *(21, 40, 41, 21, 43, 44, 21, 46, 47, 21, 49, 50, 21, 52, 53),
]
"""The parents, as the models' papers and their programs list them."""


def amass(poses: np.ndarray, **more: Any) -> bytes:
    """A file such as AMASS has, with what it also holds."""
    out = io.BytesIO()
    rest = {"mocap_framerate": np.float64(120), "betas": np.zeros(16), "gender": "female", "dmpls": np.zeros((3, 8))}
    np.savez(out, **{"poses": poses, "trans": DRAW.normal(size=(len(poses), 3)), **rest, **more})
    return out.getvalue()


def walk(joints: int) -> np.ndarray:
    """Every joint turned another way in every frame, by up to three half turns."""
    return DRAW.uniform(-3 * np.pi, 3 * np.pi, (FRAMES, joints, 3))


def turn(vector: np.ndarray) -> np.ndarray:
    """The matrix of an axis times an angle, by its series: e^K."""
    x, y, z = vector
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    total, term = np.eye(3), np.eye(3)
    for n in range(1, 60):
        term = term @ cross / n
        total = total + term
    return total


@pytest.mark.parametrize("joints", [22, 24, 52, 55])
def test_joints_are_where_their_poses_put_them(joints: int) -> None:
    """Against matrices multiplied down the tree; what is up in the file, z, is up in the figure, y."""
    poses, trans = walk(joints), DRAW.normal(size=(FRAMES, 3))
    take = opened(amass(poses.reshape(FRAMES, -1), trans=trans))
    assert (take.frames, take.frame_rate, take.vertex_count, codes(take)) == (FRAMES, 120, joints, READ)
    drawn = take.vertices(0, FRAMES)
    tree = TREES[joints]
    order = _depth_first([joint.parent for joint in tree])
    for frame in (0, 1, FRAMES - 1):
        places, turns = np.zeros((joints, 3)), [np.eye(3)] * joints
        for i, joint in enumerate(tree):
            above = turns[joint.parent] if joint.parent >= 0 else np.eye(3)
            start = places[joint.parent] if joint.parent >= 0 else trans[frame]
            places[i] = start + (above @ np.array(joint.offset) if joint.parent >= 0 else 0)
            turns[i] = above @ turn(poses[frame, i])
        x, y, z = places[order].T
        np.testing.assert_allclose(drawn[frame], np.stack([x, z, -y], axis=1), atol=2e-5)


def _depth_first(parents: list[int]) -> list[int]:
    order, waiting = [], [0]
    while waiting:
        joint = waiting.pop(0)
        order.append(joint)
        waiting = [i for i, parent in enumerate(parents) if parent == joint] + waiting
    return order


def test_the_trees_are_those_of_the_models() -> None:
    """Parent by parent; left and right alike; a person of 1.7 m lies on the floor, the arms held out."""
    for parents in (SMPL[:22], SMPL, SMPL_H, SMPL_X):
        tree = TREES[len(parents)]
        assert [joint.parent for joint in tree] == parents
        offsets = {joint.name: np.array(joint.offset) for joint in tree}
        assert len(offsets) == len(tree)
        for name, offset in offsets.items():
            if name.startswith("left_"):
                np.testing.assert_array_equal(offsets["right" + name[4:]], offset * [-1, 1, 1])
    take = opened(amass(np.zeros((2, 156)) + 1e-9 * np.arange(2)[:, None], trans=np.eye(2, 3)))
    size = np.ptp(take.vertices(0, 1)[0], axis=0)
    assert size == pytest.approx([1.72, 0.175, 1.55], abs=1e-3)  # hand to hand; the joints from the feet to the head


def test_a_joint_may_be_three_numbers_in_a_row_of_their_own() -> None:
    """(F, 24, 3) as well as (F, 72), in any kind of number."""
    poses = walk(24)
    flat, shaped = (opened(amass(p, trans=np.zeros((FRAMES, 3)))) for p in (poses.reshape(FRAMES, 72), poses))
    np.testing.assert_array_equal(flat.vertices(0, FRAMES), shaped.vertices(0, FRAMES))
    rounded = opened(amass(poses.astype(np.float32), trans=np.zeros((FRAMES, 3))))
    np.testing.assert_allclose(rounded.vertices(0, FRAMES), flat.vertices(0, FRAMES), atol=1e-5)


def test_the_rate_has_two_spellings_and_may_be_missing() -> None:
    """SMPL-X has an underscore more; a file without a rate has the one that is asked for, or 30."""
    poses = walk(22).reshape(FRAMES, 66)
    out = io.BytesIO()
    np.savez(out, poses=poses, mocap_frame_rate=60)
    assert opened(out.getvalue()).frame_rate == 60
    out = io.BytesIO()
    np.savez(out, poses=poses)
    assert (opened(out.getvalue()).frame_rate, codes(opened(out.getvalue()))) == (30, READ | {"frame-rate-assumed"})
    asked = opened(out.getvalue(), fps=25)
    assert (asked.frames, asked.frame_rate, codes(asked)) == (FRAMES, 25, READ)


def test_a_surface_beside_the_poses_is_what_is_read() -> None:
    """Whoever ran the model has better than bones of ours."""
    vertices = DRAW.normal(size=(FRAMES, 5, 3))
    take = opened(amass(walk(24), vertices=vertices, triangles=np.array([[0, 1, 2], [2, 3, 4]])))
    assert (take.vertex_count, len(take.triangles)) == (5, 2)
    assert codes(take) == {"members-ignored", "frame-rate-assumed"}


def test_what_is_said_names_the_bones() -> None:
    """And that the shape of the person is not known."""
    (said,) = (n.detail for n in opened(amass(walk(52))).notices if n.code == "bone-lengths-assumed")
    assert "52 joints" in said
    assert "1.7 m" in said


def test_the_header_tells_joints_and_frames() -> None:
    """Of an archive whose other members may be anything, such as pickled notes."""
    data = amass(walk(52).reshape(FRAMES, 156), markers_latent_vids=np.array({"a": 1}, dtype=object))
    header = read_header(io.BytesIO(data), "a.npz", Limits())
    assert (header.format, header.vertices, header.triangles) == ("npz", 52, 0)
    assert header.takes == (HeaderTake(0, "motion", pytest.approx(29 / 120), FRAMES, 120.0),)
    assert opened(data).vertex_count == 52


def test_limits_hold() -> None:
    """Before any pose is read."""
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_FRAMES"):
        opened(amass(walk(24)), Limits(max_frames=FRAMES - 1))
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_DECODED_BYTES"):
        opened(amass(walk(24)), Limits(max_decoded_bytes=10_000))
