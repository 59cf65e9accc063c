"""The compiled loops of counting: over tiles of (columns, frames), and over frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bits = NDArray[np.int32]
Floats = NDArray[np.float32]
Codes = NDArray[np.uint16]
Bins = NDArray[np.uint8]
Sums = NDArray[np.int64]


SHIFT = 11
"""Bits of a float32 that a code leaves out: 12 of the 23 of its mantissa stay."""

TOGETHER = 16
"""Triangles whose codes are written together: half a line of the cache."""


@njit(nogil=True, cache=True, inline="always")
def quantise(bits: np.int32, lowest: np.int32) -> np.uint16:
    """The leading bits of a float32 ≥ 0, given as the integer it spells, from `lowest` on, in 16 bits."""
    return np.uint16(min(max(np.int32(np.int32(bits >> SHIFT) - lowest), np.int32(0)), np.int32(65535)))


@njit(nogil=True, cache=True)
def count_codes(
    tile: Bits, noise: Bits, lowest: np.int32, floor: np.int32, histogram: Sums
) -> tuple[np.int32, np.int64]:
    """Count the codes of a tile from `floor` on, all below as 0.

    Values ≥ 0 are given as the integers that their bits spell, which rise with them. Returns the largest, and how
    many in row t are above noise[t]. Counting one by one is what costs, and few rows reach the floor.
    """
    largest, above, counted = np.int32(0), np.int64(0), 0
    least = np.int32((floor + lowest) << SHIFT)
    for t in range(tile.shape[0]):
        row, limit, top, more = tile[t], noise[t], np.int32(0), np.int32(0)
        for f in range(row.size):
            top = max(top, row[f])
            more += np.int32(row[f] > limit)
        largest, above = max(largest, top), above + more
        for f in range(row.size if top >= least else 0):
            if row[f] >= least:
                histogram[quantise(row[f], lowest)] += 1
                counted += 1
    histogram[0] += tile.size - counted
    return largest, above


@njit(nogil=True, cache=True)
def write_codes(tile: Bits, lowest: np.int32, codes: Codes, column: int) -> None:
    """codes[f, column + t] = code of tile[t, f]; as many triangles at a time as share a line of the cache."""
    together = tile.shape[0] // TOGETHER * TOGETHER
    few = np.empty((TOGETHER, tile.shape[1]), np.uint16)
    for start in range(0, together, TOGETHER):
        for t in range(TOGETHER):
            for f in range(tile.shape[1]):
                few[t, f] = quantise(tile[start + t, f], lowest)
        for f in range(tile.shape[1]):
            for t in range(TOGETHER):  # a constant, so that the loop is unrolled
                codes[f, np.uint64(column + start + t)] = few[t, f]
    for t in range(together, tile.shape[0]):
        for f in range(tile.shape[1]):
            codes[f, column + t] = quantise(tile[t, f], lowest)


@njit(nogil=True, cache=True)
def look_up_bins(codes: Codes, bin_of_code: Bins, bins: Bins) -> None:
    """bins[f, t] = bin_of_code[codes[f, t]]."""
    for f in range(codes.shape[0]):
        for t in range(codes.shape[1]):
            bins[f, t] = bin_of_code[codes[f, t]]


@njit(nogil=True, cache=True)
def count_pairs(first: Bins, second: Bins, levels: int, counts: Bits) -> None:
    """counts[f, i B + j] = how many columns are in bin i of frame f of `first` and in bin j of that of `second`.

    Neighbouring columns count in different tables: they are often in the same bins, and would wait for each other.
    """
    tables = np.zeros((4, counts.shape[1]), np.int32)
    for f in range(counts.shape[0]):
        one, other = first[f], second[f]
        tables[:] = 0
        for t in range(one.size):
            tables[np.uint64(t) & np.uint64(3), np.uint64(one[t]) * np.uint64(levels) + np.uint64(other[t])] += 1
        for c in range(counts.shape[1]):
            counts[f, c] = tables[0, c] + tables[1, c] + tables[2, c] + tables[3, c]


@njit(nogil=True, cache=True)
def slide_window(counts: Bits, length: int, sums: Sums) -> None:
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
def entropy_of_counts(counts: Sums, out: NDArray[np.float64]) -> None:
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
