"""The compiled loops of coding and counting: tiles of (columns, frames), the innermost loop over frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from core.descriptors.kernels import FAST

Floats = NDArray[np.float32]
Codes = NDArray[np.uint16]
Bins = NDArray[np.uint8]


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def encode(tile: Floats, gain: np.float32, lowest: np.int32, shift: np.int32, codes: Codes) -> None:
    """codes[t, f]: the leading bits of gain · tile[t, f], from `lowest` on, held within 16 bits."""
    for t in range(tile.shape[0]):
        for f in range(tile.shape[1]):
            bits = np.int32(np.float32(tile[t, f] * gain).view(np.int32))
            codes[t, f] = np.uint16(min(max(np.int32((bits >> shift) - lowest), np.int32(0)), np.int32(65535)))


@njit(nogil=True, cache=True)
def add_histogram(codes: Codes, histogram: NDArray[np.int64]) -> None:
    """histogram[c] += how often code c occurs."""
    for t in range(codes.shape[0]):
        for f in range(codes.shape[1]):
            histogram[codes[t, f]] += 1


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def largest_and_above(tile: Floats, noise: Floats, largest: Floats) -> int:
    """How many values are above their column's noise; largest[f] becomes the largest value met in frame f."""
    above = 0
    for t in range(tile.shape[0]):
        count = 0
        for f in range(tile.shape[1]):
            count += tile[t, f] > noise[t]
            largest[f] = max(largest[f], tile[t, f])
        above += count
    return above


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
def count_pairs(first: Bins, second: Bins, levels: int, counts: NDArray[np.int32]) -> None:
    """counts[f, i · levels + j] += triangles in bin i of first[:, f] and bin j of second[:, f]."""
    for t in range(first.shape[0]):
        for f in range(first.shape[1]):
            counts[f, np.int64(first[t, f]) * levels + np.int64(second[t, f])] += 1
