"""A coherent order of triangles: those near each other on the body come near each other in memory."""

import numpy as np
from jaxtyping import Float, Int

LEAF = 64
"""Triangles whose corners, over a block of 64 frames, stay in the nearest cache (32 kB)."""


def order_triangles(
    rest: Float[np.ndarray, "V 3"], triangles: Int[np.ndarray, "T 3"], tile: int
) -> Int[np.ndarray, "T"]:
    """The triangles in runs of `tile`, each a compact piece of the rest shape, itself in compact runs of `LEAF`.

    Halved again and again across the widest side of its box (a k-d tree). The corners of a compact piece are few,
    about one for two triangles, so that few vertices are fetched twice. Ties keep the order of the file.
    """
    centres = rest[triangles].mean(axis=1)
    pieces: list[np.ndarray] = []
    ahead = [np.arange(len(triangles))]
    while ahead:
        piece = ahead.pop()
        if len(piece) <= LEAF:
            pieces.append(piece)
            continue
        unit = tile if len(piece) > tile else LEAF
        half = max(len(piece) // 2 // unit, 1) * unit
        widest = np.ptp(centres[piece], axis=0).argmax()
        along = np.argsort(centres[piece, widest], kind="stable")
        ahead += [np.sort(piece[along[half:]]), np.sort(piece[along[:half]])]
    return np.concatenate(pieces) if pieces else np.zeros(0, np.int64)
