"""The compiled loops of coding and counting: tiles of (columns, frames), the innermost loop over frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bits = NDArray[np.int32]
Floats = NDArray[np.float32]
Codes = NDArray[np.uint16]
Bins = NDArray[np.uint8]
Sums = NDArray[np.int64]


RUN = 2048
"""Values that stay in the nearest cache while they are passed over several times."""

BATCH = 8
"""Triangles whose places in a table of counts are found before they are counted."""

SHIFT = 11
"""Bits of a float32 that a code leaves out: 12 of the 23 of its mantissa stay."""


@njit(nogil=True, cache=True, inline="always")
def _encode_row(bits: Bits, lowest: np.int32, codes: Codes) -> None:
    for f in range(bits.size):
        code = np.int32(np.int32(bits[f] >> SHIFT) - lowest)
        codes[f] = np.uint16(min(max(code, np.int32(0)), np.int32(65535)))


@njit(nogil=True, cache=True)
def encode(tile: Bits, lowest: np.int32, codes: Codes) -> None:
    """codes[t, f]: the leading bits of a float32 ≥ 0, given as the integer they spell, from `lowest` on, in 16 bits."""
    for t in range(tile.shape[0]):
        _encode_row(tile[t], lowest, codes[t])


@njit(nogil=True, cache=True)
def read_tile(
    tile: Bits, frames: int, noise: Bits, lowest: np.int32, floor: np.int32, codes: Codes, histogram: Sums
) -> tuple[int, int]:
    """Encode the first frames of a tile and count their codes from `floor` on, all below as 0.

    Values ≥ 0 are given as the integers that their bits spell, which rise with them: the maximum of integers
    becomes one instruction, that of floats, for the sake of NaN, does not. Counting one by one is what costs, and
    few rows reach the floor. Without rows in `codes` none is kept. Returns the largest value's bits and the number
    of values above their row's noise.
    """
    largest, above, counted = 0, 0, 0
    scratch = np.empty(frames, np.uint16)
    keep = codes.shape[0] > 0
    for t in range(tile.shape[0]):
        row, limit = tile[t][:frames], noise[t]
        top, more = np.int32(0), np.int32(0)
        for f in range(row.size):
            top = max(top, row[f])
            more = np.int32(more - np.int32(np.int32(limit - row[f]) >> 31))
        largest = max(largest, int(top))
        above += int(more)
        if keep:
            _encode_row(row, lowest, codes[t])
        if np.int32(top >> SHIFT) - lowest >= floor:
            _encode_row(row, lowest, scratch)
            for f in range(scratch.size):
                if scratch[f] >= floor:
                    histogram[scratch[f]] += 1
                    counted += 1
    histogram[0] += tile.shape[0] * frames - counted
    return largest, above


@njit(nogil=True, cache=True)
def digitize(codes: Codes, edges: Codes, bins: Bins) -> None:
    """bins[t, f] = how many edges codes[t, f] is above; `edges` come in threes, so that bins are passed over less.

    Rows do not matter here, and short ones would not fill a vector: both arrays are read as runs of `RUN`. Counted in
    16 bits, as wide as a code, and narrowed at the end.
    """
    every, out = codes.reshape(-1), bins.reshape(-1)
    count = np.empty(RUN, np.uint16)
    for start in range(0, every.size, RUN):
        run, narrow = every[start : start + RUN], out[start : start + RUN]
        for f in range(run.size):
            count[f] = 0
        for i in range(0, edges.size, 3):
            first, second, third = edges[i], edges[i + 1], edges[i + 2]
            for f in range(run.size):
                above = np.uint16(np.uint16(run[f] > first) + np.uint16(run[f] > second) + np.uint16(run[f] > third))
                count[f] = np.uint16(count[f] + above)
        for f in range(run.size):
            narrow[f] = np.uint8(count[f])


@njit(nogil=True, cache=True)
def count_pairs(first: Bins, at: int, second: Bins, second_at: int, levels: np.uint32, counts: Bits) -> None:
    """counts[f, i · levels + j] += triangles in bin i of first[:, at + f] and bin j of second[:, second_at + f].

    Places first, `BATCH` triangles of them, and then the counting: what was just written as a vector is slow to be
    read one by one.
    """
    flat, cells, width = counts.reshape(-1), counts.shape[1], counts.shape[0]
    place, start = np.empty((BATCH, width), np.uint32), np.empty(width, np.uint32)
    for f in range(width):
        start[f] = np.uint32(f * cells)
    for begin in range(0, first.shape[0], BATCH):
        size = min(BATCH, first.shape[0] - begin)
        for t in range(size):
            here = first[begin + t][at : at + width]
            there, out = second[begin + t][second_at : second_at + width], place[t]
            for f in range(width):
                out[f] = np.uint32(start[f] + np.uint32(np.uint32(here[f]) * levels) + np.uint32(there[f]))
        for t in range(size):
            for f in range(width):
                flat[place[t, f]] += 1


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
