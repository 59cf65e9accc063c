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

REACH = np.float32(1e15)
"""The largest coordinate that is read: the squares of larger ones leave float32."""

SQUARED_FLOOR = np.float32(1e-6)
"""Least squared stretch: a triangle squeezed below a thousandth counts as a thousandth, so ln stays finite."""

_LN2 = np.float32(0.6931471805599453)
_SQRT_HALF_BITS = np.int32(0x3F3504F3)


LINE = 16
"""Floats in a line of the cache."""


@njit(nogil=True, cache=True, error_model="numpy")
def gather_rows(vertices: Floats, members: Indices, rows: Floats) -> None:
    """rows[i, axis, f] = vertices[f, members[i], axis]; as many frames at a time as fill a line of the cache."""
    lines = vertices.shape[0] // LINE * LINE
    for start in range(0, lines, LINE):
        for i in range(members.size):
            for axis in range(3):
                for f in range(LINE):  # a constant, so that the loop is unrolled
                    rows[i, axis, start + f] = vertices[start + f, members[i], axis]
    for f in range(lines, vertices.shape[0]):
        for i in range(members.size):
            for axis in range(3):
                rows[i, axis, f] = vertices[f, members[i], axis]


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def largest_bits(values: Indices) -> np.int32:
    """The largest |value|, as the integer its float32 bits spell: larger for larger, largest for inf and NaN."""
    largest = np.int32(0)
    for i in range(values.size):
        largest = max(largest, values[i] & np.int32(0x7FFFFFFF))
    return largest


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


TILE = 1024
"""Triangles of a tile."""

WIDTH = 64
"""Frames in a row of strain. A constant, so that the compiler knows how long the loops are and which rows are apart."""

Y, Z = WIDTH, 2 * WIDTH
"""Where the second and the third axis of a row of vertices begin."""

MODERATE = np.float32(0.7)
"""The log strain up to which the series of `_atanh_squared` is used: stretches between a half and two."""

_MODERATE_BITS = MODERATE.view(np.int32)


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def _moderate_log_strains(
    rows: Floats, corners: Indices, shapes: Floats, scratch: Floats, tile: Floats, tops: Indices
) -> None:
    """tile[t, f] = log strain without a logarithm, good to a part in a million up to `MODERATE`.

    tops[t]: the bits of the largest.

    With λ1 ≥ λ2 the squared stretches, ln²σ1 + ln²σ2 = (p² + q²) / 2 where p = atanh((λ1 λ2 − 1) / (λ1 λ2 + 1)) and
    q = atanh((λ1 − λ2) / (λ1 + λ2)). Both squares are rational in E, B and G: one division and one root a triangle.

    In three short loops, for in one long one every value waits for the one before it, and the processor looks too few
    instructions ahead to find others that do not: it would be 1.6 times slower. `scratch` lies in one piece, at
    constant distances, so that the compiler sees that its parts are apart.
    """
    for t in range(corners.shape[0]):
        origin, first, second = rows[corners[t, 0]], rows[corners[t, 1]], rows[corners[t, 2]]
        per_c, shear = shapes[t, 1], shapes[t, 2]
        squared, doubled = shapes[t, 0] * shapes[t, 0], np.float32(2) * shapes[t, 0]
        for f in range(WIDTH):
            x1, y1, z1 = first[f] - origin[f], first[Y + f] - origin[Y + f], first[Z + f] - origin[Z + f]
            x2, y2, z2 = second[f] - origin[f], second[Y + f] - origin[Y + f], second[Z + f] - origin[Z + f]
            wx, wy, wz = x2 * per_c - x1 * shear, y2 * per_c - y1 * shear, z2 * per_c - z1 * shear
            scratch[f] = (x1 * x1 + y1 * y1 + z1 * z1) * squared  # E
            scratch[Y + f] = (x1 * wx + y1 * wy + z1 * wz) * doubled  # 2 B
            scratch[Z + f] = wx * wx + wy * wy + wz * wz  # G
        for f in range(WIDTH):
            e, b2, g = scratch[f], scratch[Y + f], scratch[Z + f]
            total, half, squared_b2 = e + g, e - g, b2 * b2
            apart = half * half + squared_b2  # (λ1 − λ2)²
            product = e * g - np.float32(0.25) * squared_b2
            # y = x / (1 − x / 2) of both, over one denominator
            below_q = total * total - np.float32(0.5) * apart
            below_p = product * (np.float32(0.5) * product + np.float32(3)) + np.float32(0.5)
            above_p = (product - np.float32(1)) * (product - np.float32(1))
            per_both = np.float32(1) / (below_p * below_q)
            scratch[f] = apart * below_p * per_both
            scratch[Y + f] = above_p * below_q * per_both
        strain, top = tile[t], np.int32(0)
        for f in range(WIDTH):
            both = _atanh_squared(scratch[f]) + _atanh_squared(scratch[Y + f])
            value = np.float32(np.sqrt(np.float32(0.5) * both))
            strain[f] = value
            top = max(top, np.int32(value.view(np.int32) & np.int32(0x7FFFFFFF)))  # NaN is the largest of all
        tops[t] = top


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def _squared_stretches(rows: Floats, corners: Indices, shape: Floats, larger: Floats, other: Floats) -> None:
    """Both squared stretches of one triangle in every frame, none below `SQUARED_FLOOR`.

    With the edges of the triangle written in its orthonormal rest frame, the columns of F are u = e1 / a and
    w = e2 / c - e1 b / (a c); `shape` holds 1 / a, 1 / c and b / (a c). E, B, G are the entries of F^T F.
    """
    origin, first, second = rows[corners[0]], rows[corners[1]], rows[corners[2]]
    per_a, per_c, shear = shape[0], shape[1], shape[2]
    for f in range(WIDTH):
        x1, y1, z1 = first[f] - origin[f], first[Y + f] - origin[Y + f], first[Z + f] - origin[Z + f]
        x2, y2, z2 = second[f] - origin[f], second[Y + f] - origin[Y + f], second[Z + f] - origin[Z + f]
        ux, uy, uz = x1 * per_a, y1 * per_a, z1 * per_a
        wx, wy, wz = x2 * per_c - x1 * shear, y2 * per_c - y1 * shear, z2 * per_c - z1 * shear
        e = ux * ux + uy * uy + uz * uz
        b = ux * wx + uy * wy + uz * wz
        g = wx * wx + wy * wy + wz * wz
        half = np.float32(0.5) * (e - g)
        most = np.float32(0.5) * (e + g) + np.sqrt(half * half + b * b)
        least = (e * g - b * b) / (most if most > SQUARED_FLOOR else SQUARED_FLOOR)
        larger[f] = most if most > SQUARED_FLOOR else SQUARED_FLOOR
        other[f] = least if least > SQUARED_FLOOR else SQUARED_FLOOR


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def strain_tile(rows: Floats, corners: Indices, shapes: Floats, measure: int, tile: Floats) -> None:
    """tile[t, f]: strain of each triangle.

    `rows` (vertices, 3 · WIDTH) hold the frames of x, then of y, then of z.

    Which way a value is computed depends on the value alone, so that no bit depends on how frames fall into blocks.
    """
    scratch, tops = np.empty(3 * WIDTH, np.float32), np.empty(corners.shape[0], np.int32)
    larger, other = scratch[:Y], scratch[Y:Z]
    if measure == LOG:
        _moderate_log_strains(rows, corners, shapes, scratch, tile, tops)
    for t in range(corners.shape[0]):
        if measure == LOG and tops[t] <= _MODERATE_BITS:
            continue
        strain = tile[t]
        _squared_stretches(rows, corners[t], shapes[t], larger, other)
        if measure == LOG:
            for f in range(WIDTH):
                most, least = _ln(larger[f]), _ln(other[f])
                extreme = np.float32(0.5) * np.sqrt(most * most + least * least)
                strain[f] = strain[f] if strain[f] <= MODERATE else extreme
        elif measure == BIOT:
            for f in range(WIDTH):
                most, least = np.sqrt(larger[f]) - np.float32(1), np.sqrt(other[f]) - np.float32(1)
                strain[f] = np.sqrt(most * most + least * least)
        else:
            for f in range(WIDTH):
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
