"""The files that the Blender add-on sends are read as what they were made of."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from blender.caesura_addon.skeleton_file import SkeletonFile, decompose, quaternions
from blender.caesura_addon.vertex_file import VertexFile, y_up
from caesura import open_animation

FRAMES, RATE = 40, 24.0
PARENTS = [-1, 0, 1, 0]


def poses():
    """Bones in the armature's space and the armature in the world, for columns, that turn and move and grow."""
    rng = np.random.default_rng(4)
    turns = Rotation.from_rotvec(np.cumsum(rng.normal(scale=0.2, size=(FRAMES, 4, 3)), axis=0).reshape(-1, 3))
    local = np.tile(np.eye(4), (FRAMES, 4, 1, 1))
    local[..., :3, :3] = turns.as_matrix().reshape(FRAMES, 4, 3, 3) * rng.uniform(0.8, 1.2, (FRAMES, 4, 1, 1))
    local[..., :3, 3] = [0, 1, 0]
    bones = local.copy()
    for bone, parent in enumerate(PARENTS):
        if parent >= 0:
            bones[:, bone] = bones[:, parent] @ local[:, bone]
    worlds = np.tile(np.eye(4), (FRAMES, 1, 1))
    worlds[:, :3, 3] = np.linspace(0, 5, FRAMES)[:, None] * [1, 0.5, 0]
    return bones, worlds


def test_the_joints_of_a_skeleton_file_are_the_bones_with_y_up(tmp_path):
    bones, worlds = poses()
    file = SkeletonFile(FRAMES, ["hip", "leg", "foot", "arm"], PARENTS, [1.0, 1.0, 0.5, 0.7], RATE)
    for start in range(0, FRAMES, 16):
        file.write(bones[start : start + 16], worlds[start : start + 16])
    file.save(tmp_path / "rig.glb")
    animation = open_animation((tmp_path / "rig.glb").read_bytes())
    assert (animation.frames, animation.frame_rate) == (FRAMES, RATE)
    expected = y_up(bones[..., :3, 3] + worlds[:, None, :3, 3])
    found = animation.vertices(0, FRAMES)
    for bone in range(4):
        nearest = np.abs(found - expected[:, None, bone]).max(axis=2).min(axis=1)
        assert nearest.max() < 1e-5, bone
    end = (bones[:, 2] @ [0, 0.5, 0, 1])[:, :3] + worlds[:, :3, 3]
    assert np.abs(found - y_up(end)[:, None]).max(axis=2).min(axis=1).max() < 1e-5


def test_the_vertices_of_a_vertex_file_stand_in_the_world_with_y_up(tmp_path):
    rng = np.random.default_rng(5)
    points = rng.normal(size=(FRAMES, 5, 3)).astype(np.float32)
    _, worlds = poses()
    file = VertexFile(tmp_path / "mesh.npz", FRAMES, 5, [[0, 1, 2], [2, 3, 4]], RATE)
    for start in range(0, FRAMES, 7):
        file.write(points[start : start + 7], worlds[start : start + 7])
    file.close()
    animation = open_animation((tmp_path / "mesh.npz").read_bytes())
    assert (animation.frames, animation.frame_rate, len(animation.triangles)) == (FRAMES, RATE, 2)
    expected = (points + worlds[:, None, :3, 3])[..., [0, 2, 1]] * [1, 1, -1]
    assert animation.vertices(0, FRAMES) == pytest.approx(expected, abs=1e-5)


def test_any_rotation_is_its_quaternion():
    rng = np.random.default_rng(6)
    halves = Rotation.from_rotvec(np.pi * np.eye(3)).as_matrix()
    axes = np.concatenate([Rotation.random(200, random_state=rng).as_matrix(), halves, np.eye(3)[None]])
    assert Rotation.from_quat(quaternions(axes)).as_matrix() == pytest.approx(axes, abs=1e-12)


def test_a_mirrored_and_a_vanished_bone_have_a_rotation_too():
    mirrored, vanished = np.diag([-2.0, 1.0, 1.0, 1.0]), np.diag([0.0, 0.0, 0.0, 1.0])
    place, turn, size = decompose(np.stack([mirrored, vanished]))
    assert np.isfinite(turn).all()
    assert np.abs(np.linalg.norm(turn, axis=1) - 1).max() < 1e-12
    assert size[0].tolist() == [-2, 1, 1]
    assert not place.any()
