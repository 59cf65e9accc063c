"""The compiled loops of sampling. Plain arrays in and out; their callers say what they mean."""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Doubles = NDArray[np.float64]
Singles = NDArray[np.float32]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

STEP, LINEAR, CUBIC = 0, 1, 2
NEAR = 0.9995
"""Cosine from which on a chord, normalised, stands for the arc: angles below 1.8°."""

compiled = njit(nogil=True, cache=True, fastmath={"contract", "reassoc", "nsz", "arcp", "afn"}, error_model="numpy")


@compiled
def sample_tracks(
    seconds: Doubles,
    times: Singles,
    first_key: Indices,
    keys: Indices,
    values: Singles,
    first_value: Indices,
    width: Indices,
    mode: Indices,
    is_rotation: Flags,
    slot: Indices,
    out: Doubles,
) -> None:
    """Write every channel's value at every time into its slot of `out` (frames, numbers)."""
    for c in range(len(slot)):
        k = 0
        clock = times[first_key[c] : first_key[c] + keys[c]]
        for f in range(len(seconds)):
            k = _key_at(clock, k, seconds[f])
            _value(clock, k, seconds[f], values, first_value[c], width[c], mode[c], is_rotation[c], out[f], slot[c])


@compiled
def _key_at(clock: Singles, k: int, t: float) -> int:
    """The last key at or before t, searched from key k on; the first where t is before all."""
    if k + 1 == len(clock) or clock[k + 1] > t:
        return k
    low, high = k + 1, len(clock)  # the answer is in [low, high)
    while high - low > 1:
        middle = (low + high) // 2
        if clock[middle] <= t:
            low = middle
        else:
            high = middle
    return low


@compiled
def _value(
    clock: Singles,
    k: int,
    t: float,
    values: Singles,
    first: int,
    n: int,
    mode: int,
    is_rotation: bool,
    out: Doubles,
    to: int,
) -> None:
    """The n numbers at time t, between key k and the next."""
    here = first + k * n if mode != CUBIC else first + 3 * k * n + n
    if mode == STEP or k + 1 == len(clock) or t <= clock[k]:
        for i in range(n):
            out[to + i] = values[here + i]
    else:
        step = float(clock[k + 1]) - float(clock[k])
        s = (t - float(clock[k])) / step
        if mode == CUBIC:
            _hermite(values, here, n, s, step, out, to)
        elif is_rotation:
            _slerp(values, here, s, out, to)
        else:
            for i in range(n):
                a = float(values[here + i])
                out[to + i] = a + s * (float(values[here + n + i]) - a)
    if is_rotation and mode == CUBIC:
        _normalise(out, to)


@compiled
def _hermite(values: Singles, here: int, n: int, s: float, step: float, out: Doubles, to: int) -> None:
    """Cubic spline between the keys at `here` and 3n further on; [in-tangent, value, out-tangent] per key."""
    s2, s3 = s * s, s * s * s
    p0, m0, p1, m1 = 2 * s3 - 3 * s2 + 1, step * (s3 - 2 * s2 + s), 3 * s2 - 2 * s3, step * (s3 - s2)
    for i in range(n):
        out[to + i] = (
            p0 * values[here + i]
            + m0 * values[here + n + i]
            + p1 * values[here + 3 * n + i]
            + m1 * values[here + 2 * n + i]
        )


@compiled
def _slerp(values: Singles, here: int, s: float, out: Doubles, to: int) -> None:
    """Along the shorter arc between the quaternions at `here` and 4 further on, of about unit length."""
    cosine, same = 0.0, True
    for i in range(4):
        a, b = values[here + i], values[here + 4 + i]
        cosine += float(a) * float(b)
        same = same and a == b
    u, v = 1.0 - s, s
    sign = -1.0 if cosine < 0 else 1.0
    near = abs(cosine) >= NEAR
    if not near:
        angle = math.acos(abs(cosine))
        u, v = math.sin(u * angle) / math.sin(angle), math.sin(v * angle) / math.sin(angle)
    for i in range(4):
        out[to + i] = values[here + i] if same else u * values[here + i] + sign * v * values[here + 4 + i]
    if near and not same:
        _normalise(out, to)


@compiled
def _normalise(out: Doubles, to: int) -> None:
    """Make the quaternion at `to` a unit one; a spline may pass through zero, which turns nothing."""
    square = 0.0
    for i in range(4):
        square += out[to + i] * out[to + i]
    if square > 0:
        for i in range(4):
            out[to + i] /= math.sqrt(square)
    else:
        out[to + 3] = 1.0
