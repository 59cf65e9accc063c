"""The welded mesh: points, the triangles that have area between them, and where they are in a block of frames."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32, Float64, Int, Int32

from caesura.core.frames.vertex_rows import gather_rows
from caesura.core.kernels.descriptors import TILE


@dataclass(frozen=True)
class Mesh:
    """P points and the triangles between them, in the order of a surface's columns.

    `members` (P,) is the vertex of the file that stands for each point; `rest` (P, 3) and `areas` (columns,) are
    at rest.
    """

    members: Int32[np.ndarray, "P"]
    corners: Int32[np.ndarray, "columns 3"]
    rest: Float32[np.ndarray, "P 3"]
    areas: Float64[np.ndarray, "columns"]

    @classmethod
    def of(
        cls,
        rest: Float32[np.ndarray, "V 3"],
        triangles: Int[np.ndarray, "columns 3"],
        same: Int[np.ndarray, "V"],
    ) -> "Mesh":
        """The triangles, each of which has area at rest, with vertex v taken for `same[v]`."""
        members, corners = np.unique(same[triangles], return_inverse=True)
        corners = corners.reshape(-1, 3).astype(np.int32)
        place = rest[members].astype(np.float64)
        origin, first, second = place[corners.T]
        areas = np.linalg.norm(np.cross(first - origin, second - origin), axis=1) / 2
        return cls(members.astype(np.int32), corners, rest[members], areas)

    def rows(self, block: Float32[np.ndarray, "frames V 3"]) -> Float32[np.ndarray, "P 3 frames"]:
        """Where the points are, the frames innermost."""
        rows = np.empty((len(self.members), 3, len(block)), np.float32)
        gather_rows(block, self.members, rows)
        return rows

    def rows_at_rest(self) -> Float32[np.ndarray, "P 3 1"]:
        """Where the points are at rest, as one frame."""
        return np.ascontiguousarray(self.rest[:, :, None])

    def cells(self) -> Float64[np.ndarray, "P"]:
        """The area at rest that belongs to each point: a third of every triangle around it."""
        thirds = np.repeat(self.areas / 3, 3)
        return np.bincount(self.corners.ravel(), weights=thirds, minlength=len(self.members))

    def tiles(self) -> Iterator[slice]:
        """The columns, a tile at a time."""
        for start in range(0, len(self.corners), TILE):
            yield slice(start, min(start + TILE, len(self.corners)))

    def on_triangles(self, columns: slice, values: Float[np.ndarray, "P *rest"]) -> Float[np.ndarray, "n *rest"]:
        """The mean over the corners of each triangle, of values at the points."""
        a, b, c = self.corners[columns].T
        return np.asarray((values[a] + values[b] + values[c]) / values.dtype.type(3))
