"""The compiled loops of the descriptors: tiles of (columns, frames), the innermost loop over frames.

A tile holds a few hundred triangles over the frames of one block. Its vertices are first gathered into rows of
frames, (vertex, axis, frame), so that every later load is contiguous and the loops become vector instructions.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Indices = NDArray[np.int32]

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}  # not nnan, ninf: they delete checks for finiteness

LOG, BIOT, MAX = 0, 1, 2

SQUARED_FLOOR = np.float32(1e-6)
"""Least squared stretch: a triangle squeezed below a thousandth counts as a thousandth, so ln stays finite."""

_LN2 = np.float32(0.6931471805599453)
_SQRT_HALF_BITS = np.int32(0x3F3504F3)


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def largest_bits(values: Indices) -> np.int32:
    """The largest |value|, as the integer its float32 bits spell: larger for larger, largest for inf and NaN."""
    largest = np.int32(0)
    for i in range(values.size):
        largest = max(largest, values[i] & np.int32(0x7FFFFFFF))
    return largest


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def gather(vertices: Floats, members: Indices, rows: Floats) -> None:
    """rows[i, axis, f] = vertices[f, members[i], axis].

    Four frames at a time: few enough to be read ahead as streams, enough to write runs of each row.
    """
    frames = vertices.shape[0]
    fours = frames // 4 * 4
    for f in range(0, fours, 4):
        first, second, third, fourth = vertices[f], vertices[f + 1], vertices[f + 2], vertices[f + 3]
        for i in range(members.size):
            v, row = members[i], rows[i]
            for axis in range(3):
                row[axis, f] = first[v, axis]
                row[axis, f + 1] = second[v, axis]
                row[axis, f + 2] = third[v, axis]
                row[axis, f + 3] = fourth[v, axis]
    for f in range(fours, frames):
        for i in range(members.size):
            for axis in range(3):
                rows[i, axis, f] = vertices[f, members[i], axis]


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy", inline="always")
def _ln(x: np.float32) -> np.float32:
    """Natural logarithm of a positive normal float32, to about 1e-7 of its value, about 1 too.

    x = 2^k m with m in [sqrt(1/2), sqrt(2)); near 1, k is 0 and m - 1 exact. The polynomial is Cephes' logf.
    """
    bits = np.int32(np.float32(x).view(np.int32) - _SQRT_HALF_BITS)
    k = np.float32(np.int32(bits >> 23))
    m = np.int32((bits & 0x007FFFFF) + _SQRT_HALF_BITS).view(np.float32) - np.float32(1)
    p = np.float32(7.0376836292e-2)
    p = p * m - np.float32(1.1514610310e-1)
    p = p * m + np.float32(1.1676998740e-1)
    p = p * m - np.float32(1.2420140846e-1)
    p = p * m + np.float32(1.4249322787e-1)
    p = p * m - np.float32(1.6668057665e-1)
    p = p * m + np.float32(2.0000714765e-1)
    p = p * m - np.float32(2.4999993993e-1)
    p = p * m + np.float32(3.3333331174e-1)
    return m + m * m * (p * m - np.float32(0.5)) + k * _LN2


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy", inline="always")
def _atanh_squared(y: np.float32) -> np.float32:
    """atanh²(√x) of x = y / (1 + y / 2), for y ≥ 0.

    A function of y that has its singularities evenly on both sides, so six terms (minimax over x ≤ 0.6) are enough
    for 2.4e-6 of its value there; it rises everywhere, so what is too large for it shows.
    """
    p = np.float32(2.312886498617349e-2)
    p = p * y - np.float32(6.962277576976919e-3)
    p = p * y + np.float32(3.857194320919095e-2)
    p = p * y + np.float32(9.200695244406235e-2)
    p = p * y + np.float32(1.6685639326823115e-1)
    p = p * y + np.float32(9.999976359827095e-1)
    return p * y


MODERATE = np.float32(0.7)
"""The log strain up to which the series of `_atanh_squared` is used: stretches between a half and two."""


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def _moderate_log_strains(
    rows: Floats, corners: Indices, shapes: Floats, scale: Floats, tile: Floats, beyond: NDArray[np.bool_]
) -> None:
    """tile[t, f] = log strain without a logarithm, good to a part in a million up to `MODERATE`; rows that go beyond.

    With λ1 ≥ λ2 the squared stretches, ln²σ1 + ln²σ2 = (p² + q²) / 2 where p = atanh((λ1 λ2 − 1) / (λ1 λ2 + 1)) and
    q = atanh((λ1 − λ2) / (λ1 + λ2)). Both squares are rational in E, B and G: one division and one root a triangle.
    """
    for t in range(corners.shape[0]):
        origin, first, second = rows[corners[t, 0]], rows[corners[t, 1]], rows[corners[t, 2]]
        ox, oy, oz = origin[0], origin[1], origin[2]
        px, py, pz = first[0], first[1], first[2]
        qx, qy, qz = second[0], second[1], second[2]
        per_c, shear = shapes[t, 1], shapes[t, 2]
        squared, doubled = shapes[t, 0] * shapes[t, 0], np.float32(2) * shapes[t, 0]
        strain = tile[t]
        outside = np.float32(0)  # a float32, for a count of integers would be 64 bits wide and halve the vectors
        for f in range(strain.size):
            x1, y1, z1 = px[f] - ox[f], py[f] - oy[f], pz[f] - oz[f]
            x2, y2, z2 = qx[f] - ox[f], qy[f] - oy[f], qz[f] - oz[f]
            wx, wy, wz = x2 * per_c - x1 * shear, y2 * per_c - y1 * shear, z2 * per_c - z1 * shear
            e = (x1 * x1 + y1 * y1 + z1 * z1) * squared
            b2 = (x1 * wx + y1 * wy + z1 * wz) * doubled
            g = wx * wx + wy * wy + wz * wz
            total, half = e + g, e - g
            apart = half * half + b2 * b2  # (λ1 − λ2)²
            product = (e * g - np.float32(0.25) * b2 * b2) * scale[f] * scale[f]
            # y = x / (1 − x / 2) of both, over one denominator
            below_q = total * total - np.float32(0.5) * apart
            below_p = product * (np.float32(0.5) * product + np.float32(3)) + np.float32(0.5)
            above_p = (product - np.float32(1)) * (product - np.float32(1))
            per_both = np.float32(1) / (below_p * below_q)
            q = _atanh_squared(apart * below_p * per_both)
            p = _atanh_squared(above_p * below_q * per_both)
            value = np.sqrt(np.float32(0.5) * (p + q))
            strain[f] = value
            outside += np.float32(0) if value <= MODERATE else np.float32(1)  # NaN is outside
        beyond[t] = outside != np.float32(0)


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def _squared_stretches(
    rows: Floats, corners: Indices, shape: Floats, scale: Floats, larger: Floats, other: Floats
) -> None:
    """Both squared stretches of one triangle in every frame, none below `SQUARED_FLOOR`.

    With the edges of the triangle written in its orthonormal rest frame, the columns of F are u = e1 / a and
    w = e2 / c - e1 b / (a c); `shape` holds 1 / a, 1 / c and b / (a c). E, B, G are the entries of F^T F.
    """
    origin, first, second = rows[corners[0]], rows[corners[1]], rows[corners[2]]
    per_a, per_c, shear = shape[0], shape[1], shape[2]
    for f in range(larger.size):
        x1, y1, z1 = first[0, f] - origin[0, f], first[1, f] - origin[1, f], first[2, f] - origin[2, f]
        x2, y2, z2 = second[0, f] - origin[0, f], second[1, f] - origin[1, f], second[2, f] - origin[2, f]
        ux, uy, uz = x1 * per_a, y1 * per_a, z1 * per_a
        wx, wy, wz = x2 * per_c - x1 * shear, y2 * per_c - y1 * shear, z2 * per_c - z1 * shear
        e = ux * ux + uy * uy + uz * uz
        b = ux * wx + uy * wy + uz * wz
        g = wx * wx + wy * wy + wz * wz
        half = np.float32(0.5) * (e - g)
        most = np.float32(0.5) * (e + g) + np.sqrt(half * half + b * b)
        least = (e * g - b * b) / (most if most > SQUARED_FLOOR else SQUARED_FLOOR) * scale[f]
        most *= scale[f]
        larger[f] = most if most > SQUARED_FLOOR else SQUARED_FLOOR
        other[f] = least if least > SQUARED_FLOOR else SQUARED_FLOOR


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def strain_tile(
    rows: Floats, corners: Indices, shapes: Floats, scale: Floats, measure: int, stretches: Floats, tile: Floats
) -> None:
    """tile[t, f]: strain of each triangle; `stretches`, two rows of scratch; `scale[f]` times the squared stretches.

    Which way a value is computed depends on the value alone, so that no bit depends on how frames fall into blocks.
    """
    larger, other = stretches[0], stretches[1]
    beyond = np.ones(corners.shape[0], np.bool_)
    if measure == LOG:
        _moderate_log_strains(rows, corners, shapes, scale, tile, beyond)
    for t in range(corners.shape[0]):
        if not beyond[t]:
            continue
        strain = tile[t]
        _squared_stretches(rows, corners[t], shapes[t], scale, larger, other)
        if measure == LOG:
            for f in range(strain.size):
                most, least = _ln(larger[f]), _ln(other[f])
                extreme = np.float32(0.5) * np.sqrt(most * most + least * least)
                strain[f] = strain[f] if strain[f] <= MODERATE else extreme
        elif measure == BIOT:
            for f in range(strain.size):
                most, least = np.sqrt(larger[f]) - np.float32(1), np.sqrt(other[f]) - np.float32(1)
                strain[f] = np.sqrt(most * most + least * least)
        else:
            for f in range(strain.size):
                most, least = np.sqrt(larger[f]) - np.float32(1), np.sqrt(other[f]) - np.float32(1)
                strain[f] = max(abs(most), abs(least))


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def add_areas(rows: Floats, corners: Indices, twice: NDArray[np.float64]) -> None:
    """twice[f] += twice the area of every triangle of the tile in frame f; `twice` is float64."""
    for t in range(corners.shape[0]):
        origin, first, second = rows[corners[t, 0]], rows[corners[t, 1]], rows[corners[t, 2]]
        for f in range(twice.size):
            x1, y1, z1 = first[0, f] - origin[0, f], first[1, f] - origin[1, f], first[2, f] - origin[2, f]
            x2, y2, z2 = second[0, f] - origin[0, f], second[1, f] - origin[1, f], second[2, f] - origin[2, f]
            x, y, z = y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2
            twice[f] += np.sqrt(x * x + y * y + z * z)


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def add_weighted(tile: Floats, weights: Floats, groups: Indices, sums: Floats) -> None:
    """sums[groups[t], f] += weights[t] tile[t, f], one column after another."""
    for t in range(tile.shape[0]):
        row, weight = sums[groups[t]], weights[t]
        for f in range(tile.shape[1]):
            row[f] += weight * tile[t, f]


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def pair_changes(
    rows: Floats, first: Indices, second: Indices, at_rest: Floats, per_size: np.float32, changes: Floats
) -> None:
    """changes[p, f] = (distance of the ends of pair p in frame f − at_rest[p]) · per_size."""
    for p in range(first.size):
        one, other, out, rest = rows[first[p]], rows[second[p]], changes[p], at_rest[p]
        for f in range(out.size):
            x, y, z = one[0, f] - other[0, f], one[1, f] - other[1, f], one[2, f] - other[2, f]
            out[f] = (np.sqrt(x * x + y * y + z * z) - rest) * per_size
