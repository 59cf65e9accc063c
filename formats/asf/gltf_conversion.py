"""An ASF and its AMC as a glTF of the same skeleton.

A bone turns about its start, the end of its parent. At rest its own axes stand as the rotation C of the angles in its
`axes`; in a frame it is turned by M, made of the angles of the motion in the order in which its freedoms are listed. So
its rotation in its parent is C M C⁻¹, and it leads along its direction at rest.
"""

from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.asf.amc_header import CAPTURED
from caesura.formats.asf.motion import Motion, read_motion
from caesura.formats.asf.skeleton import Bone, Skeleton, read_skeleton
from caesura.formats.decode_budget import DecodeBudget
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.gltf.writer import Channel, GlbWriter
from caesura.formats.notices import Notices

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

Values = Float[np.ndarray, "frames freedoms"]
AXES = {"tx": 0, "ty": 1, "tz": 2}


def convert_amc_to_glb(data: memoryview, skeleton_data: memoryview, limits: Limits) -> GltfConversion:
    """As glTF, in metres: a node for every bone, at its start, and one more at each end that no bone follows.

    Raises `BrokenContainer` (`malformed-amc`, `malformed-asf`), `InvalidModel` or `LimitExceeded`.
    """
    skeleton = read_skeleton(bytes(skeleton_data), limits)
    DecodeBudget(limits).check(4 * len(data))
    motion = read_motion(data, limits)
    _check_freedoms(skeleton, motion)
    notices = Notices()
    if motion.head.rate is None:
        notices.add(
            "frame-rate-assumed",
            f"The AMC has no frame rate; {CAPTURED:g} frames a second are assumed. A line `:SAMPLES-PER-SECOND 60` in "
            "its head says another.",
        )
    frames = len(next(iter(motion.values.values())))
    times = (np.arange(frames) / (motion.head.rate or CAPTURED)).astype(np.float32)
    degrees = skeleton.degrees if motion.head.degrees is None else motion.head.degrees
    writer = GlbWriter()
    channels = []
    for node, bone in enumerate(skeleton.bones):
        above = skeleton.bones[bone.parent].vector if bone.parent >= 0 else (0, 0, 0)
        writer.node(bone.name, parent=bone.parent if bone.parent >= 0 else None, translation=above)
        if bone.name not in motion.values:
            continue
        values = motion.values[bone.name]
        channels.append(Channel(node, "rotation", times, _rotations(bone, values, degrees)))
        moved = [freedom for freedom in bone.freedoms if not freedom.startswith("r")]
        if moved and bone.parent >= 0:
            notices.add("freedoms-ignored", f"{bone.name[:40]} also moves or stretches; bones are turned and no more.")
        elif moved:
            channels.append(Channel(node, "translation", times, _places(bone, values, skeleton.unit)))
    for node in sorted(set(range(len(skeleton.bones))) - {bone.parent for bone in skeleton.bones}):
        writer.node(f"{skeleton.bones[node].name} end", parent=node, translation=skeleton.bones[node].vector)
    writer.animation("motion", channels)
    return GltfConversion(writer.to_bytes(), notices.in_order())


def _check_freedoms(skeleton: Skeleton, motion: Motion) -> None:
    """Raise `unmatched-skeleton` where the motion is not that of the skeleton."""
    free = {bone.name: len(bone.freedoms) for bone in skeleton.bones}
    for name, values in motion.values.items():
        if free.get(name) != values.shape[1]:
            has = f"which is free in {free[name]}" if name in free else "which it does not have"
            raise InvalidModel(
                "unmatched-skeleton",
                f"The AMC has {values.shape[1]} numbers for {name[:40]!r} of the ASF, {has}. Send the skeleton that "
                "the motion was made with.",
            )


def _rotations(bone: Bone, values: Values, degrees: bool) -> Float[np.ndarray, "frames 4"]:
    from scipy.spatial.transform import Rotation  # noqa: PLC0415  a tenth of a second that few formats need

    columns = [i for i, freedom in enumerate(bone.freedoms) if freedom.startswith("r")]
    order = "".join(bone.freedoms[i][1] for i in columns)
    at_rest = Rotation.from_euler(bone.order, bone.axes[: len(bone.order)], degrees=True)
    turned = _turned(Rotation, order, values[:, columns], degrees)
    found: Float[np.ndarray, "frames 4"] = (at_rest * turned * at_rest.inv()).as_quat().astype(np.float32)
    return found


def _turned(kind: "type[Rotation]", order: str, angles: Values, degrees: bool) -> "Rotation":
    """About the axes at rest, one after the other in the order of the freedoms."""
    if not order:
        return kind.from_quat(np.tile([0.0, 0, 0, 1], (len(angles), 1)))
    return kind.from_euler(order, angles, degrees=degrees)


def _places(bone: Bone, values: Values, unit: float) -> Float[np.ndarray, "frames 3"]:
    places = np.zeros((len(values), 3))
    for column, freedom in enumerate(bone.freedoms):
        if freedom in AXES:
            places[:, AXES[freedom]] = values[:, column] * unit
    return places.astype(np.float32)
