"""The compiled loops of counting: over tiles of (columns, frames), and over frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bits = NDArray[np.int32]
Floats = NDArray[np.float32]
Codes = NDArray[np.uint16]
Sums = NDArray[np.int64]


SHIFT = 11
"""Bits of a float32 that a code leaves out: 12 of the 23 of its mantissa stay."""


@njit(nogil=True, cache=True, inline="always")
def code_of(bits: np.int32, lowest: np.int32) -> np.uint16:
    """The leading bits of a float32 ≥ 0, given as the integer it spells, from `lowest` on, in 16 bits."""
    return np.uint16(min(max(np.int32(np.int32(bits >> SHIFT) - lowest), np.int32(0)), np.int32(65535)))


@njit(nogil=True, cache=True)
def count_above(tile: Bits, limits: Bits, above: Bits) -> None:
    """above[f] += how many tile[t, f] are above limits[t]; a sum for every frame, for one of a row waits for itself."""
    for t in range(tile.shape[0]):
        row, limit = tile[t], limits[t]
        for f in range(above.size):
            above[f] -= np.int32(np.int32(limit - row[f]) >> 31)


@njit(nogil=True, cache=True)
def count_codes(tile: Bits, tops: Bits, frames: int, lowest: np.int32, floor: np.int32, histogram: Sums) -> None:
    """Count the codes of the first frames of a tile from `floor` on, all below as 0.

    Values ≥ 0 are given as the integers that their bits spell, which rise with them; `tops` are the largest of each
    row. Counting one by one is what costs, and few rows reach the floor.
    """
    counted = 0
    scratch = np.empty(frames, np.uint16)
    for t in range(tile.shape[0]):
        if np.int32(tops[t] >> SHIFT) - lowest < floor:
            continue
        row = tile[t]
        for f in range(scratch.size):
            scratch[f] = code_of(row[f], lowest)
        for f in range(scratch.size):
            if scratch[f] >= floor:
                histogram[scratch[f]] += 1
                counted += 1
    histogram[0] += tile.shape[0] * frames - counted


@njit(nogil=True, cache=True)
def slide(counts: Bits, length: int, sums: Sums) -> None:
    """sums[m] = counts[m] + … + counts[m + length − 1], each from the one before it."""
    if sums.shape[0] == 0:
        return
    first = sums[0]
    first[:] = 0
    for row in range(length):
        for c in range(first.size):
            first[c] += counts[row, c]
    for m in range(1, sums.shape[0]):
        for c in range(first.size):
            sums[m, c] = sums[m - 1, c] + counts[m + length - 1, c] - counts[m - 1, c]


@njit(nogil=True, cache=True)
def entropy(counts: Sums, out: NDArray[np.float64]) -> None:
    """out[m] = −Σ P ln P of P = counts[m] / Σ counts[m] (Eq. 2); a logarithm only where a count has changed."""
    cells = counts.shape[1]
    terms, known = np.zeros(cells), np.zeros(cells, np.int64)
    for m in range(counts.shape[0]):
        total, weighted = np.int64(0), 0.0
        for c in range(cells):
            count = counts[m, c]
            if count != known[c]:
                known[c] = count
                terms[c] = count * np.log(count) if count > 0 else 0.0  # 0 ln 0 = 0
            total += count
            weighted += terms[c]
        out[m] = max(np.log(total) - weighted / total, 0.0) if total > 0 else 0.0
