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
def write_codes(tile: Bits, lowest: np.int32, codes: Codes) -> None:
    """codes[t, f] = code of tile[t, f]."""
    for t in range(tile.shape[0]):
        for f in range(tile.shape[1]):
            codes[t, f] = quantise(tile[t, f], lowest)


@njit(nogil=True, cache=True)
def look_up_bins(codes: Codes, bin_of_code: Bins, bins: Bins) -> None:
    """bins[t, f] = bin_of_code[codes[t, f]]."""
    for t in range(codes.shape[0]):
        for f in range(codes.shape[1]):
            bins[t, f] = bin_of_code[codes[t, f]]


@njit(nogil=True, cache=True)
def count_pairs(first: Bins, start: int, second: Bins, later: int, levels: int, counts: Bits) -> None:
    """counts[f, i B + j] = how many columns are in bin i of frame start + f of `first` and j of later + f of `second`.

    Frame after frame counts in a table of its own: a column is often in the bins of the one before it, and would wait
    for its count.
    """
    counts[:] = 0
    for t in range(first.shape[0]):
        one, other = first[t][start:], second[t][later:]
        for f in range(counts.shape[0]):
            counts[f, np.uint64(one[f]) * np.uint64(levels) + np.uint64(other[f])] += 1


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
