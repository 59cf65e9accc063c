"""The compiled loops along the edges of a mesh: rows of frames, the innermost loop over frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from caesura.core.kernels.descriptors import FAST

Floats = NDArray[np.float32]
Indices = NDArray[np.int32]


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def edge_lengths(rows: Floats, edges: Indices, lengths: Floats) -> None:
    """lengths[e, f] = distance of the ends of edge e in frame f."""
    for e in range(edges.shape[0]):
        one, other, out = rows[edges[e, 0]], rows[edges[e, 1]], lengths[e]
        for f in range(out.size):
            x, y, z = one[0, f] - other[0, f], one[1, f] - other[1, f], one[2, f] - other[2, f]
            out[f] = np.sqrt(x * x + y * y + z * z)


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy", inline="always")
def _shorten(row: Floats, other: Floats, length: Floats) -> np.int32:
    """row[f] by other[f] + length[f] where that is less; how often it was."""
    shorter = np.int32(0)
    for f in range(row.size):
        through = other[f] + length[f]
        shorter += np.int32(through < row[f])
        row[f] = through if through < row[f] else row[f]
    return shorter


@njit(nogil=True, cache=True, fastmath=FAST, error_model="numpy")
def shortest_paths(
    order: Indices, start: Indices, beside: Indices, edge: Indices, lengths: Floats, distance: Floats
) -> None:
    """distance[v, f]: the length of the shortest path of edges to v from the points where it is 0; others start at inf.

    Relaxed in `order` and back until nothing is shorter (Bellman and Ford), by neighbours alone that changed since:
    in the order of the distances at rest, which a pose changes little, that is about once for every edge and way.
    `start`, `beside` and `edge` list the neighbours of every point and the edge to each. What comes out is the least
    sum over all paths, added up from their beginning, whatever the order.
    """
    clock = np.int64(1)
    changed, seen = np.zeros((2, order.size), np.int64)
    for v in range(order.size):
        changed[v] = np.int64(distance[v, 0] == 0)
    settled = False
    while not settled:
        settled = True
        for i in range(order.size):
            v = order[i]
            since, shorter = seen[v], np.int32(0)
            seen[v] = clock
            clock += 1
            for k in range(start[v], start[v + 1]):
                if changed[beside[k]] > since:
                    shorter += _shorten(distance[v], distance[beside[k]], lengths[edge[k]])
            if shorter > 0:
                changed[v], settled = clock, False
        order = order[::-1]
