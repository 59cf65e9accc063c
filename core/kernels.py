"""The compiled loops of coding and counting: tiles of (columns, frames), the innermost loop over frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from core.descriptors.kernels import FAST

Bits = NDArray[np.int32]
Floats = NDArray[np.float32]
Codes = NDArray[np.uint16]
Bins = NDArray[np.uint8]


SHIFT = 11
"""Bits of a float32 that a code leaves out: 12 of the 23 of its mantissa stay."""


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def encode(tile: Floats, gain: np.float32, lowest: np.int32, codes: Codes) -> None:
    """codes[t, f]: the leading bits of gain · tile[t, f], from `lowest` on, held within 16 bits."""
    for t in range(tile.shape[0]):
        row, out = tile[t], codes[t]
        for f in range(row.size):
            bits = np.int32(np.float32(row[f] * gain).view(np.int32))
            code = np.int32(np.int32(bits >> SHIFT) - lowest)
            out[f] = np.uint16(min(max(code, np.int32(0)), np.int32(65535)))


@njit(nogil=True, cache=True)
def add_histogram(codes: Codes, histogram: NDArray[np.int64]) -> None:
    """histogram[c] += how often code c occurs."""
    for t in range(codes.shape[0]):
        for f in range(codes.shape[1]):
            histogram[codes[t, f]] += 1


@njit(nogil=True, cache=True)
def largest_and_above(tile: Bits, noise: Bits, largest: Bits, above: Bits) -> None:
    """Per frame, the largest value and how many are above their column's noise.

    Values ≥ 0 are given as the integers that their bits spell, which rise with them: the maximum of integers
    becomes one instruction, that of floats, for the sake of NaN, does not.
    """
    for t in range(tile.shape[0]):
        row, limit = tile[t], noise[t]
        for f in range(row.size):
            largest[f] = max(row[f], largest[f])
            above[f] -= np.int32(np.int32(limit - row[f]) >> 31)


@njit(nogil=True, cache=True)
def digitize(codes: Codes, edges: Codes, bins: Bins) -> None:
    """bins[t, f] = how many edges codes[t, f] is above."""
    for t in range(codes.shape[0]):
        row, out = codes[t], bins[t]
        for f in range(row.size):
            out[f] = 0
        for i in range(edges.size):
            edge = edges[i]
            for f in range(row.size):
                out[f] += np.uint8(row[f] > edge)


@njit(nogil=True, cache=True)
def count_pairs(first: Bins, second: Bins, levels: np.int32, counts: Bits) -> None:
    """counts[f, i · levels + j] += triangles in bin i of first[:, f] and bin j of second[:, f]."""
    flat, cells = counts.reshape(-1), np.int32(counts.shape[1])
    place = np.empty(first.shape[1], np.int32)
    for t in range(first.shape[0]):
        here, there = first[t], second[t]
        for f in range(place.size):
            place[f] = np.int32(f) * cells + np.int32(here[f]) * levels + np.int32(there[f])
        for f in range(place.size):
            flat[place[f]] += 1
