"""The whole pass over a block of vertices in one compiled call: strain, codes, counts and means, tile after tile.

Between tiles the interpreter would cost as much as a tenth of their arithmetic, and what one step leaves in the
cache the next finds there.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from core.descriptors.gathering.kernels import fetch, gather
from core.descriptors.kernels import FAST, REACH, WIDTH, Floats, Indices, add_weighted, largest_bits, strain_tile
from core.encoding.kernels import encode
from core.kernels import Codes, Sums, count_above, count_codes

UNREADABLE = -1

TOGETHER = 64
"""Triangles whose strain is read while it is in the nearest cache."""

_REACH_BITS = int(REACH.view(np.int32))


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def read_block(
    vertices: Floats,
    members: Indices,
    member_ends: NDArray[np.int64],
    corners: Indices,
    ends: NDArray[np.int64],
    shapes: Floats,
    scale: Floats,
    measure: int,
    noise: Indices,
    lowest: np.int32,
    floor: np.int32,
    groups: Indices,
    weights: Floats,
    rows: Floats,
    scratch: Floats,
    tile: Floats,
    codes: Codes,
    histogram: Sums,
    means: Floats,
) -> tuple[int, int]:
    """Every tile of up to `WIDTH` frames gathered, strained, added to the means, counted and encoded; then the next.

    Tile i has the members from `member_ends[i]` to `member_ends[i + 1]`, and the triangles likewise by `ends`. `codes`
    has no rows where none are kept, `means` none where there are no patches, and `histogram` nothing where all was
    looked at and counted before. Returns the bits of the largest strain and how many strains are above noise,
    `UNREADABLE` where a corner is no number or beyond `REACH`.
    """
    counted, largest, above = histogram.size > 0, 0, 0
    tops, more = np.empty(TOGETHER, np.int32), np.empty(WIDTH, np.int32)
    for at in range(0, vertices.shape[0], WIDTH):
        block, factors = vertices[at : at + WIDTH], scale[at : at + WIDTH]
        kept = codes[at : at + WIDTH]
        frames, more[:] = block.shape[0], 0
        for i in range(ends.size - 1):
            own, start, end = members[member_ends[i] : member_ends[i + 1]], ends[i], ends[i + 1]
            gathered = rows[: own.size]
            gather(block, own, gathered)
            _repeat_last(gathered, frames)
            if counted and largest_bits(gathered.reshape(-1).view(np.int32)) > _REACH_BITS:
                return largest, UNREADABLE
            lines = gathered.reshape((own.size, 3 * WIDTH))
            later = members[member_ends[i + 1] : member_ends[min(i + 2, ends.size - 1)]]
            for first in range(start, end, TOGETHER):
                last = min(first + TOGETHER, end)
                fetch(block, later, (first - start) * WIDTH // (end - start), (last - start) * WIDTH // (end - start))
                strain = tile[: last - first]
                strain_tile(lines, corners[first:last], shapes[first:last], factors, measure, scratch, strain, tops)
                if means.shape[0] > 0:
                    add_weighted(strain, weights[first:last], groups[first:last], means, at, frames)
                bits = strain.view(np.int32)
                if counted:
                    for t in range(last - first):
                        largest = max(largest, int(tops[t]))
                    count_above(bits, noise[first:last], more)
                    count_codes(bits, tops, frames, lowest, floor, histogram)
                if codes.shape[0] > 0:
                    encode(bits, frames, lowest, kept, first)
        for f in range(frames):
            above += int(more[f])
    return largest, above


@njit(nogil=True, cache=True)
def _repeat_last(rows: Floats, frames: int) -> None:
    """Frames that are not there repeat the last."""
    for v in range(rows.shape[0] if frames < WIDTH else 0):
        for axis in range(3):
            rows[v, axis, frames:] = rows[v, axis, frames - 1]
