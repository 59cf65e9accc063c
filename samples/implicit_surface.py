"""A closed smooth surface around a set of limbs: an implicit union of round cones, made into triangles."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np
from jaxtyping import Bool, Float, Int

BLEND = 0.85  # of the thinner end's radius: how far the join with the rest is rounded
TOUCH = 1e-6  # metres inside: a corner that was taken into the body
POLISH = 4  # rounds of evening out the triangles and returning to the surface


@dataclass(frozen=True)
class Limb:
    """A round cone: the hull of two balls. `owner` is the bone that moves it."""

    owner: int
    start: Float[np.ndarray, "3"]
    end: Float[np.ndarray, "3"]
    start_radius: float
    end_radius: float

    @property
    def blend(self) -> float:
        """Over what distance this limb melts into the others."""
        return BLEND * min(self.start_radius, self.end_radius)

    def distance(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n"]:
        """Distance to the surface, negative inside: the ball swept along the axis, its radius growing evenly."""
        axis = self.end - self.start
        along = np.clip((points - self.start) @ axis / max(axis @ axis, 1e-12), 0.0, 1.0)
        radius = self.start_radius + along * (self.end_radius - self.start_radius)
        distance: Float[np.ndarray, "n"] = np.linalg.norm(points - self.start - along[:, None] * axis, axis=1) - radius
        return distance


@dataclass(frozen=True)
class Surface:
    """Welded triangles, counter-clockwise from outside, with a unit normal per vertex."""

    vertices: Float[np.ndarray, "V 3"]
    triangles: Int[np.ndarray, "T 3"]
    normals: Float[np.ndarray, "V 3"]


def union_distance(limbs: Sequence[Limb], points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n"]:
    """Distance to all limbs together, their joins rounded: Quilez' polynomial smooth minimum."""
    total = limbs[0].distance(points)
    for limb in limbs[1:]:
        distance = limb.distance(points)
        overlap = np.maximum(limb.blend - np.abs(total - distance), 0.0)
        total = np.minimum(total, distance) - overlap**2 / (4 * limb.blend)
    return total


def polygonise_limbs(limbs: Sequence[Limb], cell: float) -> Surface:
    """The surface of the union, with triangles of about `cell` edge length."""
    reach = max(max(limb.start_radius, limb.end_radius) for limb in limbs) + 3 * cell
    ends = np.array([end for limb in limbs for end in (limb.start, limb.end)])
    low, high = ends.min(axis=0) - reach, ends.max(axis=0) + reach
    axes = [np.arange(a, b, cell) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    values = union_distance(limbs, grid.reshape(-1, 3)).reshape(grid.shape[:3])
    vertices, triangles = surface_nets(remove_ambiguous_squares(values))
    vertices = low + vertices * cell
    for _ in range(POLISH):
        vertices += 0.6 * (neighbour_mean(vertices, triangles) - vertices)
        for _ in range(2):
            normals, distance = _gradient(limbs, vertices)
            vertices -= normals * distance[:, None]
    normals, _ = _gradient(limbs, vertices)
    return Surface(vertices, triangles, normals)


def surface_nets(
    values: Float[np.ndarray, "x y z"],
) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "T 3"]]:
    """Triangles of the zero level in units of cells: one vertex a cell, one quad a crossed edge (Gibson 1998).

    The level must not reach the border of the grid.
    """
    cells = tuple(n - 1 for n in values.shape)
    total, count = np.zeros((*cells, 3)), np.zeros(cells)
    crossings = [_crossings(values, axis) for axis in range(3)]
    for axis, (crossed, point) in enumerate(crossings):
        across = [(0,) if a == axis else (0, 1) for a in range(3)]
        for back in product(*across):  # the four edges of a cell that run along the axis
            view = tuple(slice(b, b + n) for b, n in zip(back, cells, strict=True))
            total += np.where(crossed[view][..., None], point[view], 0.0)
            count += crossed[view]
    number = np.cumsum(count.reshape(-1) > 0).reshape(cells) - 1
    vertices = total[count > 0] / count[count > 0][:, None]
    quads = [_quads(axis, np.argwhere(crossed), values < 0, number) for axis, (crossed, _) in enumerate(crossings)]
    return vertices, _split(vertices, np.concatenate(quads))


def remove_ambiguous_squares(values: Float[np.ndarray, "x y z"]) -> Float[np.ndarray, "x y z"]:
    """Values without a lattice square whose signs alternate around it, for there four triangles would meet at an edge.

    The nearer of the two outer corners joins the body, so this ends; the surface is put back in its place afterwards.
    """
    values = values.copy()
    squares = [np.array([0 * u, u, u + v, v]) for u, v in combinations(np.eye(3, dtype=np.int64), 2)]
    while len(doubtful := np.concatenate([_alternating(values, square) for square in squares])):
        for corners in doubtful:
            outer = [tuple(corner) for corner in corners if values[tuple(corner)] >= 0]
            if outer:  # not yet settled by a neighbouring square
                values[min(outer, key=values.__getitem__)] = -TOUCH
    return values


def neighbour_mean(values: Float[np.ndarray, "V n"], triangles: Int[np.ndarray, "T 3"]) -> Float[np.ndarray, "V n"]:
    """The mean over the neighbours of each vertex of a closed surface."""
    total, count = np.zeros_like(values), np.zeros(len(values))
    for a, b in ((0, 1), (1, 2), (2, 0)):  # every edge once each way, for the surface is closed
        np.add.at(total, triangles[:, a], values[triangles[:, b]])
        np.add.at(count, triangles[:, a], 1.0)
    return total / count[:, None]


def _gradient(
    limbs: Sequence[Limb], points: Float[np.ndarray, "n 3"]
) -> tuple[Float[np.ndarray, "n 3"], Float[np.ndarray, "n"]]:
    step = 1e-4
    slopes = [union_distance(limbs, points + step * e) - union_distance(limbs, points - step * e) for e in np.eye(3)]
    gradient = np.stack(slopes, axis=1) / (2 * step)
    return gradient / np.linalg.norm(gradient, axis=1, keepdims=True), union_distance(limbs, points)


def _crossings(
    values: Float[np.ndarray, "x y z"], axis: int
) -> tuple[Bool[np.ndarray, "_ _ _"], Float[np.ndarray, "_ _ _ 3"]]:
    """Which edges along an axis cross the level, and where."""
    near, far = (np.take(values, range(first, values.shape[axis] - 1 + first), axis) for first in (0, 1))
    crossed = (near < 0) != (far < 0)
    point = np.moveaxis(np.indices(crossed.shape, dtype=np.float64), 0, -1)
    point[..., axis] += np.where(crossed, near / np.where(crossed, near - far, 1.0), 0.0)
    return crossed, point


def _alternating(values: Float[np.ndarray, "x y z"], square: Int[np.ndarray, "4 3"]) -> Int[np.ndarray, "n 4 3"]:
    """The corners of every lattice square of one orientation whose signs alternate."""
    places = np.array(values.shape) - square.max(axis=0)
    signs = [values[tuple(slice(c, c + n) for c, n in zip(corner, places, strict=True))] < 0 for corner in square]
    a, b, c, d = signs
    corners: Int[np.ndarray, "n 4 3"] = np.argwhere((a == c) & (b == d) & (a != b))[:, None, :] + square
    return corners


def _quads(
    axis: int,
    edges: Int[np.ndarray, "n 3"],
    inside: Bool[np.ndarray, "_ _ _"],
    number: Int[np.ndarray, "x y z"],
) -> Int[np.ndarray, "n 4"]:
    u, v = np.eye(3, dtype=np.int64)[[(axis + 1) % 3, (axis + 2) % 3]]
    around = [number[tuple((edges - back).T)] for back in (u + v, v, 0 * u, u)]
    corners = np.stack(around, axis=1)
    leaves = inside[tuple(edges.T)]  # the edge leads out of the body: the quad faces along it
    return np.where(leaves[:, None], corners, corners[:, ::-1])


def _split(vertices: Float[np.ndarray, "V 3"], quads: Int[np.ndarray, "n 4"]) -> Int[np.ndarray, "T 3"]:
    a, b, c, d = quads.T
    first = np.linalg.norm(vertices[a] - vertices[c], axis=1) <= np.linalg.norm(vertices[b] - vertices[d], axis=1)
    one = np.where(first, (a, b, c), (a, b, d)).T
    two = np.where(first, (a, c, d), (b, c, d)).T
    return np.concatenate([one, two])
