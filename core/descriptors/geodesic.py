"""Average geodesic distance: how far the rest of the surface is from each triangle, along it (Gal et al. 2007).

    g(v) = ∫ d(v, u) du / area ≈ Σ a_s d(v, s),

with d the length of the shortest path of edges, s a few sources spread over the surface and a_s the share of its area
that is nearest to s, both at rest. The value of a triangle is |ln(g / g₀)|, g being the mean over its corners: no
unit, 0 for any motion that stretches nothing, however it bends. Paths along edges are longer than the surface's own,
by up to √2 or so across a regular grid, but by about as much in every frame.

A path stays on its piece of a surface that is not connected, and so does the average.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Float64, Int, Int32

from caesura.core.descriptors.strain import ROUNDING
from caesura.core.kernels import mesh_edges
from caesura.core.mesh.edge_graph import EdgeGraph
from caesura.core.mesh.mesh import Mesh

SOURCES = 16
"""Sources on every piece. The change of their average follows that of all points: a test says how closely."""

LEAST = np.float32(1e-3)
"""The least ratio: a distance below a thousandth of that at rest counts as a thousandth."""


@dataclass(frozen=True)
class Geodesic:
    """The change of the average geodesic distance of each triangle; no unit, from 0.

    O(sources · edges) a frame, some third of a microsecond a point, whatever the length of the take.
    """

    mesh: Mesh
    net: EdgeGraph
    sources: tuple["DistanceSource", ...]
    at_rest: Float32[np.ndarray, "columns 1"]

    @classmethod
    def of(cls, mesh: Mesh) -> "Geodesic":
        """Sources are chosen at rest: on each piece, every one as far from those before it as can be."""
        net = EdgeGraph.of(mesh)
        sources = tuple(_sources(net, mesh))
        average = _average(net, sources, mesh.rows_at_rest())
        return cls(mesh, net, sources, mesh.on_triangles(slice(None), average))

    @property
    def columns(self) -> int:
        """How many triangles there are."""
        return len(self.mesh.corners)

    def tiles(
        self, block: Float32[np.ndarray, "frames V 3"]
    ) -> Iterator[tuple[slice, Float32[np.ndarray, "n frames"]]]:
        """Columns, and the change of their average distance in every frame of the block."""
        average = self.average(block)
        for columns in self.mesh.tiles():
            ratio = self.mesh.on_triangles(columns, average) / self.at_rest[columns]
            yield columns, np.abs(np.log(np.maximum(ratio, LEAST)))

    def average(self, block: Float32[np.ndarray, "frames V 3"]) -> Float32[np.ndarray, "P frames"]:
        """g of every point in every frame, in the unit of the coordinates."""
        return _average(self.net, self.sources, self.mesh.rows(block))

    def noise(self, reach: float) -> Float32[np.ndarray, "columns"]:
        """The change that rounding alone gives where coordinates go up to `reach`: that of an edge of usual length."""
        return np.full(self.columns, ROUNDING * reach / np.median(self.net.lengths), np.float32)


@dataclass(frozen=True)
class DistanceSource:
    """A point on every piece; how much it counts at each point of its piece; and all points by distance from it."""

    seeds: Int[np.ndarray, "pieces"]
    share: Float32[np.ndarray, "P"]
    order: Int32[np.ndarray, "P"]


def _sources(net: EdgeGraph, mesh: Mesh) -> Iterator[DistanceSource]:
    """`SOURCES` points on each piece, by farthest-point sampling along the surface; fewer where it has fewer."""
    cells, count = mesh.cells(), int(net.piece.max()) + 1
    whole = np.bincount(net.piece, weights=cells, minlength=count)
    nearest = np.full(len(cells), np.inf)
    owner = np.zeros(len(cells), np.int64)
    far, found = _distances_from_middle(net, mesh, cells / whole[net.piece]), []
    for number in range(SOURCES):
        seeds = _farthest_point(net.piece, far)
        distance = net.from_nearest(seeds)
        owner[distance < nearest] = number
        nearest = far = np.minimum(nearest, distance)
        found.append((seeds, np.argsort(distance, kind="stable").astype(np.int32)))
    for number, (seeds, order) in enumerate(found):
        share = np.bincount(net.piece, weights=np.where(owner == number, cells, 0), minlength=count) / whole
        if share.any():
            yield DistanceSource(seeds, share[net.piece].astype(np.float32), order)


def _distances_from_middle(net: EdgeGraph, mesh: Mesh, weight: Float64[np.ndarray, "P"]) -> Float64[np.ndarray, "P"]:
    """How far every point is from the middle of its piece, through space."""
    place = mesh.rest.astype(np.float64)
    middle = np.stack([np.bincount(net.piece, weights=weight * axis) for axis in place.T], axis=1)
    return np.asarray(np.linalg.norm(place - middle[net.piece], axis=1))


def _farthest_point(piece: Int[np.ndarray, "P"], far: Float64[np.ndarray, "P"]) -> Int[np.ndarray, "pieces"]:
    """The point of each piece where `far` is largest; the lowest of equal ones."""
    order = np.lexsort((-far, piece))
    return order[np.searchsorted(piece[order], np.arange(int(piece.max()) + 1))]


def _average(
    net: EdgeGraph, sources: tuple[DistanceSource, ...], rows: Float32[np.ndarray, "P 3 frames"]
) -> Float32[np.ndarray, "P frames"]:
    lengths = np.empty((len(net.edges), rows.shape[2]), np.float32)
    mesh_edges.edge_lengths(rows, net.edges, lengths)
    average, distance = np.zeros((2, len(rows), rows.shape[2]), np.float32)
    for source in sources:
        distance.fill(np.inf)
        distance[source.seeds] = 0
        mesh_edges.shortest_paths(source.order, net.start, net.beside, net.edge, lengths, distance)
        average += source.share[:, None] * distance
    return average
