"""Poses of a body model as a glTF of its skeleton: the rotations of the joints, and where the root is."""

import numpy as np
from jaxtyping import Float

from caesura.core.errors import InvalidModel
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.gltf.writer import Channel, GlbWriter
from caesura.formats.notices import Notices
from caesura.formats.smpl.kinematic_tree import TREES

Z_UP = (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)
"""AMASS has z up, glTF y: a quarter turn about x."""

FARTHEST = 1e30


def convert_poses_to_glb(
    poses: Float[np.ndarray, "frames joints 3"], places: Float[np.ndarray, "frames 3"], rate: float, notices: Notices
) -> GltfConversion:
    """As glTF: `poses` are axes times angles, in radians, `places` those of the pelvis, in metres.

    Raises `non-finite-data` naming a frame.
    """
    for name, values in (("poses", poses.reshape(len(poses), -1)), ("trans", places)):
        usable = (np.abs(values) < FARTHEST).all(axis=1)
        if not usable.all():
            frame = int(np.argmin(usable))
            raise InvalidModel("non-finite-data", f"A number of {name} is not finite.", frame=frame)
    times = (np.arange(len(poses)) / rate).astype(np.float32)
    writer = GlbWriter()
    world = writer.node("world", rotation=Z_UP)
    channels = []
    tree = TREES[poses.shape[1]]
    for number, joint in enumerate(tree):
        turned = rotations_of_vectors(poses[:, number])
        parent = world if joint.parent < 0 else world + 1 + joint.parent
        node = writer.node(joint.name, parent=parent, translation=joint.offset, rotation=turned[0])
        if (turned != turned[0]).any():
            channels.append(Channel(node, "rotation", times, turned))
    channels.append(Channel(world + 1, "translation", times, places.astype(np.float32)))
    writer.animation("motion", channels)
    notices.add(
        "bone-lengths-assumed",
        f"The file has poses of a body model and no body. They move a skeleton of its {len(tree)} joints, whose bones "
        "have lengths of Caesura's own: those of a person of 1.7 m. The shape (betas) is not used.",
    )
    return GltfConversion(writer.to_bytes(), notices.in_order())


def rotations_of_vectors(vectors: Float[np.ndarray, "frames 3"]) -> Float[np.ndarray, "frames 4"]:
    """Unit quaternions of axes times angles: (sin(θ/2) v/θ, cos(θ/2)) with θ = |v|."""
    angle = np.linalg.norm(vectors.astype(np.float64), axis=1, keepdims=True)
    axis_share = np.sinc(angle / (2 * np.pi)) / 2  # sin(θ/2) / θ, which is 1/2 at 0
    return np.concatenate([vectors * axis_share, np.cos(angle / 2)], axis=1).astype(np.float32)
