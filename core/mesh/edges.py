"""The edges of a welded mesh, the two triangles that meet at each, and what is connected by them."""

import numpy as np
from jaxtyping import Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


def list_edges(corners: Int[np.ndarray, "columns 3"]) -> tuple[Int[np.ndarray, "E 2"], Int[np.ndarray, "columns 3"]]:
    """Each edge once, its lower end first; and of every triangle the edges opposite to its corners 0, 1 and 2."""
    sides = np.stack([corners[:, [1, 2]], corners[:, [2, 0]], corners[:, [0, 1]]], axis=1).reshape(-1, 2)
    edges, which = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    return edges.astype(np.int64), which.reshape(-1, 3).astype(np.int64)


def find_hinges(corners: Int[np.ndarray, "columns 3"]) -> Int[np.ndarray, "hinges 4"]:
    """The edges where exactly two triangles meet: from a to b as the first one winds, then the two far corners.

    An edge of one triangle is a border; where three or more meet there is no angle to speak of. Both are left out.
    """
    _, which = list_edges(corners)
    order = np.argsort(which.ravel(), kind="stable")
    _, start, count = np.unique(which.ravel()[order], return_index=True, return_counts=True)
    first, second = order[start[count == 2]], order[start[count == 2] + 1]
    flat = corners.ravel()
    triangle, corner = first // 3, first % 3
    a, b = corners[triangle, (corner + 1) % 3], corners[triangle, (corner + 2) % 3]
    return np.stack([a, b, flat[first], flat[second]], axis=1).astype(np.int64)


def label_connected_pieces(edges: Int[np.ndarray, "E 2"], points: int) -> Int[np.ndarray, "points"]:
    """The connected piece, from 0, that each point is in."""
    joined = coo_array((np.ones(len(edges)), edges.T), shape=(points, points))
    return np.asarray(connected_components(joined, directed=False)[1], np.int64)
