"""The compiled loops of sampling and posing. Plain arrays in and out; their callers say what they mean."""

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

FLOAT32_MAX = 3.4028234663852886e38


compiled = njit(nogil=True, cache=True, fastmath={"contract", "reassoc", "nsz", "arcp", "afn"}, error_model="numpy")

exact = njit(nogil=True, cache=True, fastmath={"contract", "nsz", "arcp", "afn"}, error_model="numpy")
"""Without leave to reorder sums: a frame has the same bits whichever frames it is drawn with."""

TILE = 32
"""Vertices whose sums are held at a time."""


@compiled
def sample(
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


@compiled
def _product(a: Doubles, b: Doubles, out: Doubles) -> None:
    """a · b of affine matrices, row by row 3 x 4; `out` is neither."""
    for r in range(3):
        for c in range(4):
            out[4 * r + c] = a[4 * r] * b[c] + a[4 * r + 1] * b[4 + c] + a[4 * r + 2] * b[8 + c]
        out[4 * r + 3] += a[4 * r + 3]


@compiled
def worlds(pose: Doubles, parent: Indices, matrix: Doubles, has_matrix: Flags, out: Doubles) -> None:
    """World matrices (frames, N, 12) of nodes whose parents come before them, from poses (frames, 10 N, …)."""
    local = np.empty(12)
    for f in range(len(pose)):
        for n in range(len(parent)):
            if has_matrix[n]:
                local[:] = matrix[n]
            else:
                _matrix(pose[f], 10 * n, local)
            if parent[n] < 0:
                out[f, n] = local
            else:
                _product(out[f, parent[n]], local, out[f, n])


@compiled
def _matrix(pose: Doubles, at: int, out: Doubles) -> None:
    """Translation · rotation · scale as one affine matrix."""
    x, y, z, w = pose[at + 3], pose[at + 4], pose[at + 5], pose[at + 6]
    a, b, c = pose[at + 7], pose[at + 8], pose[at + 9]
    out[0], out[1], out[2] = (1 - 2 * (y * y + z * z)) * a, 2 * (x * y - z * w) * b, 2 * (x * z + y * w) * c
    out[4], out[5], out[6] = 2 * (x * y + z * w) * a, (1 - 2 * (x * x + z * z)) * b, 2 * (y * z - x * w) * c
    out[8], out[9], out[10] = 2 * (x * z - y * w) * a, 2 * (y * z + x * w) * b, (1 - 2 * (x * x + y * y)) * c
    out[3], out[7], out[11] = pose[at], pose[at + 1], pose[at + 2]


@compiled
def palette(world: Doubles, joints: Indices, bind: Doubles, out: Doubles) -> None:
    """world[joint] · bind of every joint, the frames innermost: out (J, 12, frames)."""
    product = np.empty(12)
    for j in range(len(joints)):
        for f in range(len(world)):
            _product(world[f, joints[j]], bind[j], product)
            for i in range(12):
                out[j, i, f] = product[i]


@exact
def skin(
    positions: Singles, first: Indices, joints: Indices, weights: Doubles, matrices: Doubles, start: int, out: Singles
) -> bool:
    """Σ weight · matrix[joint] · position of vertices start …, in every frame of out (frames, V, 3); whether finite.

    Vertex v of `positions` is moved by the joints first[v] … first[v + 1] - 1. Vertices go in tiles whose sums, with
    the frames innermost, stay in the fastest memory and become vector instructions.
    """
    frames, finite = len(out), True
    sums = np.empty((3 * TILE, frames))
    for tile in range(0, len(positions), TILE):
        count = min(TILE, len(positions) - tile)
        sums[:] = 0.0
        for v in range(count):
            x, y, z = float(positions[tile + v, 0]), float(positions[tile + v, 1]), float(positions[tile + v, 2])
            for k in range(first[tile + v], first[tile + v + 1]):
                w, m = weights[k], matrices[joints[k]]
                for r in range(3):
                    for f in range(frames):
                        place = m[4 * r, f] * x + m[4 * r + 1, f] * y + m[4 * r + 2, f] * z + m[4 * r + 3, f]
                        sums[3 * v + r, f] += w * place
        finite = _store(sums, count, start + tile, out) and finite
    return finite


@exact
def skin_morphed(
    positions: Singles,
    targets: Singles,
    shares: Doubles,
    first: Indices,
    joints: Indices,
    weights: Doubles,
    matrices: Doubles,
    start: int,
    out: Singles,
) -> bool:
    """As `skin`, of positions + Σ share · target: targets (targets, V 3), shares (targets, frames)."""
    frames, finite = len(out), True
    sums, places = np.empty((3 * TILE, frames)), np.empty((3, frames))
    for tile in range(0, len(positions), TILE):
        count = min(TILE, len(positions) - tile)
        sums[:] = 0.0
        for v in range(count):
            _displaced(positions[tile + v], targets, shares, 3 * (tile + v), places)
            for k in range(first[tile + v], first[tile + v + 1]):
                w, m = weights[k], matrices[joints[k]]
                for r in range(3):
                    for f in range(frames):
                        x, y, z = places[0, f], places[1, f], places[2, f]
                        place = m[4 * r, f] * x + m[4 * r + 1, f] * y + m[4 * r + 2, f] * z + m[4 * r + 3, f]
                        sums[3 * v + r, f] += w * place
        finite = _store(sums, count, start + tile, out) and finite
    return finite


@exact
def _displaced(position: Singles, targets: Singles, shares: Doubles, at: int, out: Doubles) -> None:
    """Where one vertex is in every frame, (3, frames), before the skin moves it."""
    for r in range(3):
        out[r, :] = position[r]
        for t in range(len(targets)):
            shift = float(targets[t, at + r])
            if shift != 0:
                for f in range(shares.shape[1]):
                    out[r, f] += shares[t, f] * shift


@exact
def _store(sums: Doubles, count: int, start: int, out: Singles) -> bool:
    """Write a tile of sums, the frames innermost, into frames; whether float32 can hold them."""
    finite = True
    for f in range(len(out)):
        for v in range(count):
            for r in range(3):
                place = sums[3 * v + r, f]
                finite = finite and abs(place) <= FLOAT32_MAX
                out[f, start + v, r] = place
    return finite
