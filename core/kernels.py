"""The compiled loops of coding and counting: tiles of (columns, frames), the innermost loop over frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bits = NDArray[np.int32]
Floats = NDArray[np.float32]
Codes = NDArray[np.uint16]
Bins = NDArray[np.uint8]


RUN = 2048
"""Values that stay in the nearest cache while they are passed over several times."""

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
    tile: Bits, noise: Bits, lowest: np.int32, floor: np.int32, codes: Codes, histogram: Bits
) -> tuple[int, int]:
    """Encode a tile and count its codes from `floor` on, all below as 0; its largest value, and how many are noise's.

    Values ≥ 0 are given as the integers that their bits spell, which rise with them: the maximum of integers
    becomes one instruction, that of floats, for the sake of NaN, does not. Counting one by one is what costs, and
    few rows reach the floor. Returns the largest value's bits and the number of values above their row's noise.
    """
    largest, above, counted = 0, 0, 0
    for t in range(tile.shape[0]):
        row, limit, out = tile[t], noise[t], codes[t]
        _encode_row(row, lowest, out)
        top, more = np.int32(0), np.int32(0)
        for f in range(row.size):
            top = max(top, row[f])
            more = np.int32(more - np.int32(np.int32(limit - row[f]) >> 31))
        largest = max(largest, int(top))
        above += int(more)
        if np.int32(top >> SHIFT) - lowest >= floor:
            for f in range(out.size):
                if out[f] >= floor:
                    histogram[out[f]] += 1
                    counted += 1
    histogram[0] += tile.size - counted
    return largest, above


@njit(nogil=True, cache=True)
def digitize(codes: Codes, edges: Codes, bins: Bins) -> None:
    """bins[t, f] = how many edges codes[t, f] is above; `edges` come in threes, so that bins are passed over less.

    Rows do not matter here, and short ones would not fill a vector: both arrays are read as runs of `RUN`.
    """
    every, out = codes.reshape(-1), bins.reshape(-1)
    for start in range(0, every.size, RUN):
        run, count = every[start : start + RUN], out[start : start + RUN]
        for f in range(run.size):
            count[f] = 0
        for i in range(0, edges.size, 3):
            first, second, third = edges[i], edges[i + 1], edges[i + 2]
            for f in range(run.size):
                count[f] += np.uint8(run[f] > first) + np.uint8(run[f] > second) + np.uint8(run[f] > third)


@njit(nogil=True, cache=True)
def count_pairs(first: Bins, at: int, second: Bins, second_at: int, levels: np.int32, counts: Bits) -> None:
    """counts[f, i · levels + j] += triangles in bin i of first[:, at + f] and bin j of second[:, second_at + f]."""
    flat, cells, width = counts.reshape(-1), np.int32(counts.shape[1]), counts.shape[0]
    place = np.empty(width, np.int32)
    for t in range(first.shape[0]):
        here, there = first[t][at : at + width], second[t][second_at : second_at + width]
        for f in range(place.size):
            place[f] = np.int32(f) * cells + np.int32(here[f]) * levels + np.int32(there[f])
        for f in range(place.size):
            flat[place[f]] += 1
