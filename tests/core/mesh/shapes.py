"""Meshes to measure: sheets that roll up, the bar of the other tests, and their copies in pieces."""

import numpy as np
from threadpoolctl import threadpool_limits

from caesura.core.mesh.mesh import Mesh


def sheet(columns=12, rows=5):
    """A flat sheet of squares of side 1, each in two triangles."""
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    place = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], 1).astype(np.float32)
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower = np.stack([first, first + 1, first + columns], 1)
    upper = np.stack([first + 1, first + columns + 1, first + columns], 1)
    return place, np.concatenate([lower, upper])


def rolled(place, angle):
    """The sheet, folded by `angle` along each of its columns: every triangle keeps its shape."""
    column = place[:, 0].astype(int)
    turns = angle * np.arange(column.max())
    along = np.concatenate([[0], np.cumsum(np.cos(turns))])
    up = np.concatenate([[0], np.cumsum(np.sin(turns))])
    return np.stack([along[column], place[:, 1], up[column]], 1)


def in_pieces(triangles, *places):
    """Every triangle with vertices of its own, as files without an index have them."""
    return np.arange(triangles.size).reshape(-1, 3), *(np.asarray(p)[..., triangles.ravel(), :] for p in places)


def mesh(place, triangles):
    """A mesh whose vertices are all points of their own."""
    place = np.asarray(place, np.float32)
    return Mesh.of(place, triangles, np.arange(len(place)))


def values(surface, vertices):
    """(frames, columns) of a surface on some frames."""
    block = np.ascontiguousarray(vertices, np.float32)
    with threadpool_limits(1):
        return np.concatenate([tile.copy() for _, tile in surface.tiles(block)]).T
