"""Poses at any time: the keys of a take, interpolated."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.formats.gltf.animation.channels import WIDTHS, Channel
from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.posing.node_graph import R, S, T, unit_rotations
from caesura.formats.kernels.keyframe_sampling import CUBIC, LINEAR, STEP, sample_tracks

MODES = {"STEP": STEP, "LINEAR": LINEAR, "CUBICSPLINE": CUBIC}
PLACES = {"translation": T.start, "rotation": R.start, "scale": S.start}

PoseSlots = dict[int, int]
"""Where a node's numbers begin in the pose of a frame."""


@dataclass(frozen=True)
class KeyTracks:
    """All channels of a take in one table, so that a block of frames is one call.

    Keys of channel c are times[first_key[c]:][:keys[c]], its values begin at values[first_value[c]] with width[c]
    numbers a key, or three times as many (in-tangent, value, out-tangent) in a cubic spline. `still` is the pose
    of a frame where nothing moves: ten numbers for every node, then the weights of morph targets. `first` and
    `duration` are the times of the first and the last key in seconds, `densest` the most key times that one channel
    has.
    """

    rest_pose: Float[np.ndarray, "numbers"]
    times: Float[np.ndarray, "all_times"]
    values: Float[np.ndarray, "all_values"]
    first_key: Int[np.ndarray, "channels"]
    keys: Int[np.ndarray, "channels"]
    first_value: Int[np.ndarray, "channels"]
    width: Int[np.ndarray, "channels"]
    mode: Int[np.ndarray, "channels"]
    is_rotation: np.ndarray
    slot: Int[np.ndarray, "channels"]
    first: float
    duration: float
    densest: Float[np.ndarray, "most_keys"]

    def poses(self, seconds: Float[np.ndarray, "block"]) -> Float[np.ndarray, "block numbers"]:
        """The poses at some times, which must not decrease; clamped before the first and after the last key.

        LINEAR rotations turn along the shorter arc, CUBICSPLINE tangents are scaled by the distance of their
        keys and rotations normalised (glTF 2.0, appendix C).
        """
        out = np.tile(self.rest_pose, (len(seconds), 1))
        sample_tracks(
            seconds, self.times, self.first_key, self.keys, self.values, self.first_value, self.width, self.mode,
            self.is_rotation, self.slot, out,
        )  # fmt: skip
        return out


def read_tracks(
    accessors: Accessors,
    channels: list[Channel],
    still: Float[np.ndarray, "numbers"],
    nodes: PoseSlots,
    weights: PoseSlots,
) -> KeyTracks:
    """The keys of `channels`. Channels of nodes that are not in `nodes` or `weights` move nothing that is drawn."""
    used = [channel for channel in channels if channel.node in (weights if channel.path == "weights" else nodes)]
    inputs = {channel.input.index: channel.input for channel in channels}
    clocks = {index: _times(accessors, layout) for index, layout in inputs.items()}
    times, first_key = _concatenate(clocks)
    outputs = {channel.output.index: channel for channel in used}
    values, first_value = _concatenate({index: _values(accessors, channel) for index, channel in outputs.items()})
    return KeyTracks(
        rest_pose=still,
        times=times,
        values=values,
        first_key=_column([first_key[channel.input.index] for channel in used]),
        keys=_column([channel.input.count for channel in used]),
        first_value=_column([first_value[channel.output.index] for channel in used]),
        width=_column([_width(channel) for channel in used]),
        mode=_column([MODES[channel.interpolation] for channel in used]),
        is_rotation=np.array([channel.path == "rotation" for channel in used], bool),
        slot=_column([_slot(channel, nodes, weights) for channel in used]),
        first=float(times.min()),
        duration=float(times.max()),
        densest=max(clocks.values(), key=len),
    )


def _times(accessors: Accessors, layout: AccessorLayout) -> Float[np.ndarray, "keys"]:
    times = accessors.floats(layout)[:, 0]
    if times[0] < 0 or (np.diff(times) < 0).any():
        raise layout.entry.refusal("Key times must not be negative and must not decrease.", "invalid-animation")
    return times


def _values(accessors: Accessors, channel: Channel) -> Float[np.ndarray, "numbers"]:
    values = accessors.floats(channel.output)
    if channel.path == "rotation":
        is_cubic = channel.interpolation == "CUBICSPLINE"
        rotations = values[1::3] if is_cubic else values  # tangents may be zero
        if not rotations.any(axis=1).all():
            raise channel.output.entry.refusal("A rotation is zero, which is no rotation.")
        if not is_cubic:
            values = unit_rotations(values, rounded=channel.output.dtype.kind != "f")
    return values.reshape(-1)


def _width(channel: Channel) -> int:
    tangents = 3 if channel.interpolation == "CUBICSPLINE" else 1
    return WIDTHS.get(channel.path) or channel.output.count // (channel.input.count * tangents)


def _slot(channel: Channel, nodes: PoseSlots, weights: PoseSlots) -> int:
    return weights[channel.node] if channel.path == "weights" else nodes[channel.node] + PLACES[channel.path]


def _concatenate(arrays: dict[int, Float[np.ndarray, "_"]]) -> tuple[Float[np.ndarray, "_"], dict[int, int]]:
    """All arrays as one, and where each begins in it."""
    sizes = np.cumsum([0, *(len(array) for array in arrays.values())]).tolist()
    joined = np.concatenate(list(arrays.values())) if arrays else np.zeros(0, np.float32)
    return joined, dict(zip(arrays, sizes, strict=False))


def _column(numbers: list[int]) -> Int[np.ndarray, "channels"]:
    return np.array(numbers, np.int64)
