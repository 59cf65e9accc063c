"""One captured motion on several bodies: joints, a skinned surface, markers on it, and a body with longer limbs."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from benchmarks.takes.acclaim import Acclaim, Bone
from benchmarks.takes.body import body
from benchmarks.takes.recordings import Recording, as_markers
from caesura.core.limits import Limits
from caesura.formats.bvh.gltf_conversion import read_motion_values
from caesura.formats.bvh.hierarchy import read_bvh_header

CENTIMETRE = 0.01
LIMBS = ("femur", "tibia", "humerus", "radius")
LONGER, LARGER = 1.35, 1.15
"""A larger body: its limbs are a third longer, the rest of it a seventh."""

Course = Float[np.ndarray, "frames freedoms"]


def on_other_bodies(path: Path) -> Iterator[tuple[str, Recording]]:
    """A BVH file with CMU's bones, by what its motion is played on."""
    skeleton, motion, rate = read_captured(path)
    surface = body(skeleton)
    rotations, starts = skeleton.pose(motion, len(motion["root"]))
    skin = Recording(surface.posed(rotations, starts), surface.triangles, rate)
    yield "as a skinned surface", skin
    yield "as markers on the skin", as_markers(skin)
    yield "on a larger body", Recording(_joints(larger(skeleton), motion), None, rate)


def read_captured(path: Path) -> tuple[Acclaim, dict[str, Course], float]:
    """Bones, their motion, and frames a second: each joint is a bone that ends where its children begin."""
    data = path.read_bytes()
    head = read_bvh_header(data, Limits.none())
    values = read_motion_values(memoryview(data), head)
    ends = {joint.parent: np.array(joint.offset) * CENTIMETRE for joint in reversed(head.joints)}
    bones: list[Bone] = []
    motion: dict[str, Course] = {}
    column = 0
    number = {-1: -1}
    for place, joint in enumerate(head.joints):
        if place in ends:  # an end is no bone
            number[place] = len(bones)
            freedoms = tuple(("r" if "rotation" in c else "t") + c[0].lower() for c in reversed(joint.channels))
            bones.append(Bone(joint.name, number[joint.parent], ends[place], np.eye(3), freedoms))
            motion[joint.name] = values[:, column : column + len(freedoms)][:, ::-1]
        column += len(joint.channels)
    return Acclaim(tuple(bones), CENTIMETRE), motion, head.rate


def larger(skeleton: Acclaim) -> Acclaim:
    """The same skeleton grown, its limbs more than the rest; the root goes as far as before."""
    return replace(skeleton, bones=tuple(
        replace(bone, vector=bone.vector * (LONGER if bone.name.endswith(LIMBS) else LARGER)) for bone in skeleton.bones
    ))  # fmt: skip


def _joints(skeleton: Acclaim, motion: dict[str, Course]) -> Float[np.ndarray, "frames joints 3"]:
    """Where bones begin, and where those without children end."""
    rotations, starts = skeleton.pose(motion, len(motion["root"]))
    last = [i for i in range(len(skeleton.bones)) if i not in {bone.parent for bone in skeleton.bones}]
    vectors = np.stack([skeleton.bones[i].vector for i in last])
    return np.concatenate([starts, starts[:, last] + (rotations[:, last] @ vectors[:, :, None])[..., 0]], axis=1)
