"""A lighter mesh for the screen: vertices that stay close at every pose looked at are drawn as one of them.

Vertex clustering on a grid (Rossignac and Borrel, 1993), with two changes for meshes that move: the cell of a vertex
is taken in several poses at once, so that a hand resting on a hip is not sewn to it; and a cluster is drawn by one
of its own vertices, so that its path through time is one the file holds.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

STEPS = 20  # halvings of the cell's size


@dataclass(frozen=True)
class DecimatedMesh:
    """`vertices` are the file's vertices that are kept; `triangles` index these; `triangle_of` is each one's origin."""

    vertices: Int[np.ndarray, "kept"]
    triangles: Int[np.ndarray, "shown 3"]
    triangle_of: Int[np.ndarray, "shown"]


def decimate_mesh(
    poses: Float[np.ndarray, "poses V 3"], triangles: Int[np.ndarray, "T 3"], most: int = 30_000
) -> DecimatedMesh:
    """The mesh itself where it has at most `most` triangles, else the finest clustering found that has.

    The cell's size is found by bisection between nothing and the size of the body.
    """
    if len(triangles) <= most:
        used = np.unique(triangles)
        return DecimatedMesh(used, np.searchsorted(used, triangles), np.arange(len(triangles)))
    low, high = 0.0, float(np.ptp(poses, axis=1).max())
    best = _cluster_vertices(poses, triangles, high)
    for _ in range(STEPS):
        cell = (low + high) / 2
        attempt = _cluster_vertices(poses, triangles, cell)
        if len(attempt.triangles) > most:
            low = cell
            continue
        high, best = cell, attempt
        if len(attempt.triangles) > 0.9 * most:
            break
    return best


def _cluster_vertices(
    poses: Float[np.ndarray, "poses V 3"], triangles: Int[np.ndarray, "T 3"], cell: float
) -> DecimatedMesh:
    """The mesh with one vertex kept of those that share a cell in every pose."""
    lowest = poses.min(axis=1, keepdims=True)
    cells = np.floor((poses - lowest) / cell).astype(np.int64)
    key = np.zeros(poses.shape[1], np.int64)
    for column in cells.transpose(0, 2, 1).reshape(-1, poses.shape[1]):
        # Renumbered at each step, so that the product of two small numbers never wraps.
        key = np.unique(key * (int(column.max()) + 1) + column, return_inverse=True)[1]
    _, kept, cluster = np.unique(key, return_index=True, return_inverse=True)
    drawn = cluster[triangles]
    corners = np.sort(drawn, axis=1)
    flat = (corners[:, 0] == corners[:, 1]) | (corners[:, 1] == corners[:, 2])
    whole = np.flatnonzero(~flat)
    _, first = np.unique(corners[whole], axis=0, return_index=True)
    origin = whole[np.sort(first)]
    used = np.unique(drawn[origin])
    return DecimatedMesh(kept[used], np.searchsorted(used, drawn[origin]), origin)
