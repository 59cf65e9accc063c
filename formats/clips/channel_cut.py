"""Cuts a part out of a channel without a change to its motion."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Shaped

from caesura.formats.clips.channel_keys import ChannelKeys
from caesura.formats.clips.rotation_spline import normalise_spline_ends

ON_KEY_SECONDS = 4e-6
"""A key so near to a cut stands for it: float32 times cannot say it better, and nothing moves far meanwhile."""


@dataclass(frozen=True)
class ChannelPart:
    """Keys of a clip. Where `window` is not None they are keys [first, first + count) of the source, untouched.

    `linear`: they are to be mixed, whatever those of the source are.
    """

    times: Float[np.ndarray, "keys"]
    values: Shaped[np.ndarray, "keys parts width"]
    window: tuple[int, int] | None = None
    linear: bool = False

    @property
    def is_still(self) -> bool:
        """One key, which holds all the time."""
        return len(self.times) == 1


def cut_channel(keys: ChannelKeys, start: float, end: float, origin: float) -> ChannelPart:
    """The keys within [start, end], with one on either end, timed from `origin`. One key where nothing moves.

    Keys that lie where they are cut are used as they are stored; a value between two keys is computed, and then
    integers become the floats they stand for, for no integer may be near enough.
    """
    near = min(float(np.spacing(np.float32(max(abs(start), abs(end), 1e-9)))), ON_KEY_SECONDS)
    first = int(np.searchsorted(keys.times, start + near, "right"))
    last = max(int(np.searchsorted(keys.times, end - near, "left")), first)
    on_start = first > 0 and bool(keys.times[first - 1] >= start - near)
    on_end = last < len(keys.times) and bool(keys.times[last] <= end + near)
    times = np.concatenate([[start], keys.times[first:last], [end]]) - origin
    seconds = times.astype(np.float32)
    if on_start and on_end and (np.diff(seconds) > 0).all():
        window = (first - 1, last - first + 2)
        return _reduce_to_one_key(keys, ChannelPart(seconds, keys.stored[first - 1 : last + 1], window))
    if keys.interpolation == "STEP":
        picked = np.searchsorted(keys.times, [start + near, end + near], "right") - 1
        rows = np.concatenate([[max(picked[0], 0)], np.arange(first, last), [max(picked[1], 0)]])
        return _reduce_to_one_key(keys, _drop_equal_times(ChannelPart(seconds, keys.stored[rows])))
    if keys.is_spline:
        return _reduce_to_one_key(
            keys, _drop_equal_times(_spline(keys, start, end, slice(first, last), (on_start, on_end), origin))
        )
    edges = keys.at(np.array([start, end]))[:, None]
    values = np.concatenate([edges[:1], keys.rows[first:last], edges[1:]]).astype(np.float32)
    return _reduce_to_one_key(keys, _drop_equal_times(ChannelPart(seconds, values)))


def extend_to_clip(part: ChannelPart, start: float, end: float, origin: float) -> ChannelPart:
    """The same with a key at either end, where one key held all the time: so the clip is as long as it should be.

    A clip of a take's last frame alone has no length, and keeps its one key.
    """
    seconds = (np.array([start, end]) - origin).astype(np.float32)
    if not part.is_still or seconds[0] == seconds[1]:
        return part
    return ChannelPart(seconds, np.repeat(part.values, 2, axis=0))


def value_of_single_key(keys: ChannelKeys, part: ChannelPart) -> ChannelPart:
    """The value alone of a spline's one key; a rotation's is made of unit length, as every value of a spline is."""
    values = part.values[:, 1:2]
    if keys.is_rotation and values.dtype.kind == "f":
        values = (values / np.linalg.norm(values, axis=2, keepdims=True)).astype(values.dtype)
    return ChannelPart(part.times, values)


def _spline(
    keys: ChannelKeys, start: float, end: float, interior: slice, on: tuple[bool, bool], origin: float
) -> ChannelPart:
    first, last = interior.start, interior.stop
    head = keys.rows[first - 1 : first] if on[0] else keys.spline(np.array([start]))
    tail = keys.rows[last : last + 1] if on[1] else keys.spline(np.array([end]))
    rows = np.concatenate([head, keys.rows[interior], tail])
    if first == 0 and not on[0]:  # it stands still until its first key
        rows[1, 0] = 0
    if last == len(keys.times) and not on[1]:
        rows[-2, 2] = 0
    times = np.concatenate([[start], keys.times[interior], [end]])
    if keys.is_rotation:
        times, rows = normalise_spline_ends(times, rows)
    return ChannelPart((times - origin).astype(np.float32), rows.astype(np.float32))


def _drop_equal_times(part: ChannelPart) -> ChannelPart:
    """Without keys that rounding has put at the time of another; the ends stay, or the first where all are one."""
    if part.times[0] == part.times[-1]:
        return ChannelPart(part.times[:1], part.values[:1])
    kept = np.ones(len(part.times), bool)
    kept[1:-1] = (part.times[1:-1] > part.times[:-2]) & (part.times[1:-1] < part.times[-1])
    return ChannelPart(part.times[kept], part.values[kept])


def _reduce_to_one_key(keys: ChannelKeys, part: ChannelPart) -> ChannelPart:
    """One key, at the clip's beginning, where all are the same; a spline's tangents must be nothing then."""
    values = part.values
    tangents = values[:, ::2].any() if keys.is_spline else False
    if tangents or (values != values[:1]).any():
        return part
    return ChannelPart(part.times[:1], values[:1])
