"""The net of edges that paths along a surface follow."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float64, Int, Int32
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from caesura.core.mesh.edges import label_connected_pieces, list_edges
from caesura.core.mesh.mesh import Mesh


@dataclass(frozen=True)
class EdgeGraph:
    """The edges between points, listed point by point, their lengths at rest, and the piece that each point is in."""

    edges: Int32[np.ndarray, "E 2"]
    lengths: Float64[np.ndarray, "E"]
    start: Int32[np.ndarray, "starts"]
    beside: Int32[np.ndarray, "ends"]
    edge: Int32[np.ndarray, "ends"]
    piece: Int[np.ndarray, "P"]

    @classmethod
    def of(cls, mesh: Mesh) -> "EdgeGraph":
        """The net of a mesh."""
        edges, _ = list_edges(mesh.corners)
        points = len(mesh.members)
        here, there = np.concatenate([edges, edges[:, ::-1]]).T
        order = np.argsort(here, kind="stable")
        start = np.searchsorted(here[order], np.arange(points + 1))
        lengths = np.linalg.norm(np.diff(mesh.rest.astype(np.float64)[edges], axis=1)[:, 0], axis=1)
        edge = np.tile(np.arange(len(edges)), 2)[order]
        small = (part.astype(np.int32) for part in (edges, start, there[order], edge))
        ends, starts, beside, along = small
        return cls(ends, lengths, starts, beside, along, label_connected_pieces(edges, points))

    def from_nearest(self, seeds: Int[np.ndarray, "seeds"]) -> Float64[np.ndarray, "P"]:
        """The distance at rest of every point from the nearest of some (Dijkstra 1959)."""
        points = len(self.piece)
        graph = csr_array((self.lengths[self.edge], self.beside, self.start), shape=(points, points))
        return np.asarray(dijkstra(graph, directed=True, indices=seeds, min_only=True))
