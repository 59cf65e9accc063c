"""Vertices with the frames innermost in memory, as the compiled loops want them.

A block of frames is always indexed (frame, vertex, axis). Where its memory is (vertex, axis, frame) nothing needs to be
turned over before the loops over frames.
"""

import numpy as np
from jaxtyping import Float32, Int32

from caesura.core.kernels import descriptors


def rows_of(block: Float32[np.ndarray, "frames V 3"]) -> Float32[np.ndarray, "V 3 frames"] | None:
    """The memory of a block that has the frames innermost; None of any other."""
    rows = block.transpose(1, 2, 0)
    return rows if rows.flags.c_contiguous and not block.flags.c_contiguous else None


def gather_rows(
    block: Float32[np.ndarray, "frames V 3"],
    members: Int32[np.ndarray, "n"],
    out: Float32[np.ndarray, "n 3 width"],
    first: int = 0,
) -> None:
    """Some vertices in the frames from `first` on, as many as `out` has room for; the room beyond the last is left."""
    rows, last = rows_of(block), min(first + out.shape[2], len(block))
    if rows is None:
        descriptors.gather_rows(np.ascontiguousarray(block[first:last]), members, out)
    else:
        out[:, :, : last - first] = rows[members, :, first:last]
