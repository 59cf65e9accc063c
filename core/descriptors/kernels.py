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
    """rows[i, axis, f] = vertices[f, members[i], axis]."""
    for i in range(members.size):
        v = members[i]
        for f in range(vertices.shape[0]):
            rows[i, 0, f] = vertices[f, v, 0]
            rows[i, 1, f] = vertices[f, v, 1]
            rows[i, 2, f] = vertices[f, v, 2]


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


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def strain_tile(
    rows: Floats, corners: Indices, shapes: Floats, scale: Floats, measure: int, other: Floats, tile: Floats
) -> None:
    """tile[t, f]: strain of each triangle; `other` is a row of scratch; `scale[f]` multiplies the squared stretches.

    With the edges of the triangle written in its orthonormal rest frame, the columns of F are u = e1 / a and
    w = e2 / c - e1 b / (a c); `shapes` holds 1 / a, 1 / c and b / (a c). E, B, G are the entries of F^T F.
    """
    for t in range(corners.shape[0]):
        origin, first, second = rows[corners[t, 0]], rows[corners[t, 1]], rows[corners[t, 2]]
        per_a, per_c, shear = shapes[t, 0], shapes[t, 1], shapes[t, 2]
        larger = tile[t]
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
        if measure == LOG:
            for f in range(larger.size):
                most, least = _ln(larger[f]), _ln(other[f])
                larger[f] = np.float32(0.5) * np.sqrt(most * most + least * least)
        elif measure == BIOT:
            for f in range(larger.size):
                most, least = np.sqrt(larger[f]) - np.float32(1), np.sqrt(other[f]) - np.float32(1)
                larger[f] = np.sqrt(most * most + least * least)
        else:
            for f in range(larger.size):
                most, least = np.sqrt(larger[f]) - np.float32(1), np.sqrt(other[f]) - np.float32(1)
                larger[f] = max(abs(most), abs(least))


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
