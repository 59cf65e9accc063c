"""A BVH as a GLB of the same skeleton, so that there is one way to sample, to pose and to show it."""

import warnings

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.bvh.hierarchy import BvhHeader, BvhJoint, malformed_bvh, read_bvh_header
from caesura.formats.decode_budget import DecodeBudget
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.gltf.writer import Channel, GlbWriter

AXES = {"X": 0, "Y": 1, "Z": 2}

AT_ONCE = 2**18
"""Rotations that are computed together."""


def convert_bvh_to_glb(data: memoryview, limits: Limits) -> GltfConversion:
    """As glTF: a node for every joint, and the rotations and places of those that have channels.

    Raises `BrokenContainer("malformed-bvh")`, `InvalidModel` or `LimitExceeded`.
    """
    head = read_bvh_header(bytes(data[: 2**23]), limits)
    limits.check("max_frames", head.frames, "Cut the take")
    DecodeBudget(limits).check(4 * len(data) + head.frames * 4 * len(head.joints) * 8)
    values = read_motion_values(data, head)
    writer = GlbWriter()
    for joint in head.joints:
        writer.node(joint.name, parent=None if joint.parent < 0 else joint.parent, translation=joint.offset)
    times = (np.arange(head.frames) / head.rate).astype(np.float32)
    writer.animation("motion", _has_position(head, values, times))
    return GltfConversion(writer.to_bytes())


def read_motion_values(data: memoryview, head: BvhHeader) -> Float[np.ndarray, "frames columns"]:
    """The numbers of all frames."""
    count = head.frames * head.columns
    if count == 0:
        raise InvalidModel("no-motion", "The BVH has no frames, or none of its joints moves.")
    text = bytes(data[head.start :])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            # Never told how many: where there are fewer, NumPy fills up with whatever lies in memory.
            values = np.fromstring(text, np.float64, sep=" ")[:count]
        except (ValueError, DeprecationWarning):
            raise malformed_bvh("has something that is no number among its frames") from None
    if len(values) < count:
        raise malformed_bvh(f"has {len(values):,} numbers, of {count:,} in {head.frames:,} frames")
    if not (np.abs(values) < 1e30).all():
        raise InvalidModel(
            "non-finite-data", "A number of the motion is not finite.", frame=_refuse_frame(values, head)
        )
    return values.reshape(head.frames, head.columns)


def _refuse_frame(values: Float[np.ndarray, "numbers"], head: BvhHeader) -> int:
    return int(np.argmin(np.abs(values) < 1e30)) // head.columns


def _has_position(
    head: BvhHeader, values: Float[np.ndarray, "frames columns"], times: Float[np.ndarray, "frames"]
) -> list[Channel]:
    ends = np.cumsum([len(joint.channels) for joint in head.joints])
    rotations = _joint_rotations(head, values, ends)
    found = []
    for node, joint in enumerate(head.joints):
        if node in rotations:
            found.append(Channel(node, "rotation", times, rotations[node]))
        if any(channel.endswith("position") for channel in joint.channels):
            own = values[:, ends[node] - len(joint.channels) : ends[node]]
            found.append(Channel(node, "translation", times, _joint_positions(joint, own)))
    return found


def _joint_positions(joint: BvhJoint, own: Float[np.ndarray, "frames channels"]) -> Float[np.ndarray, "frames 3"]:
    """Where a joint is in its parent: on the axes that it has channels for, these and not its offset."""
    places = np.tile(np.array(joint.offset, np.float64), (len(own), 1))
    for column, channel in enumerate(joint.channels):
        if channel.endswith("position"):
            places[:, AXES[channel[0]]] = own[:, column]
    return places.astype(np.float32)


def _joint_rotations(
    head: BvhHeader, values: Float[np.ndarray, "frames columns"], ends: Int[np.ndarray, "joints"]
) -> dict[int, Float[np.ndarray, "frames 4"]]:
    """The rotations of every joint that has any: many joints at once where there are few frames, else a few."""
    from scipy.spatial.transform import Rotation  # noqa: PLC0415  a tenth of a second that no other format needs

    columns = [
        [end - len(joint.channels) + place for place, name in enumerate(joint.channels) if name.endswith("rotation")]
        for joint, end in zip(head.joints, ends.tolist(), strict=True)
    ]
    by_order: dict[str, list[int]] = {}
    for node, joint in enumerate(head.joints):
        order = "".join(name[0] for name in joint.channels if name.endswith("rotation"))
        if order:
            by_order.setdefault(order, []).append(node)
    at_once = max(AT_ONCE // head.frames, 1)
    found: dict[int, Float[np.ndarray, "frames 4"]] = {}
    for order, nodes in by_order.items():
        for first in range(0, len(nodes), at_once):
            some = nodes[first : first + at_once]
            degrees = values[:, np.array([columns[node] for node in some])]
            # About the axes in the order of the channels, each as the ones before have turned it.
            turned = Rotation.from_euler(order, degrees, degrees=True).as_quat().astype(np.float32)
            found |= {node: np.ascontiguousarray(turned[:, place]) for place, node in enumerate(some)}
    return found
