"""Heat kernel signature: how much of a drop of heat is still where it fell, for a range of times (Sun et al. 2009).

    h_t(v) = Σ_i exp(−λ_i t) φ_i(v)²,    L φ_i = λ_i A φ_i,

with L the cotangent Laplacian and A the area around each point. The value of a triangle is the root mean square of
ln(h_t / h_t at rest) over `TIMES` times t, from 4 ln 10 / λ_k, when heat has left its neighbourhood, to 4 ln 10 / λ_2,
when it is everywhere; h_t is the mean over the corners: no unit, 0 for any motion that stretches nothing.

At rest the `MODES` smoothest eigenfunctions φ are found. In a frame, L and A are assembled anew but looked at in the
space of those functions alone (Rayleigh and Ritz): a problem of a few dozen unknowns in place of one for every point.
Where the deformation is smooth that space holds the frame's own eigenfunctions very nearly. Pieces of a surface that
is not connected hold their heat for themselves, each with its own functions and times.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Float64, Int
from scipy.linalg import eigh

from caesura.core.descriptors.strain import ROUNDING
from caesura.core.errors import LimitExceeded
from caesura.core.mesh.edges import label_connected_pieces, list_edges
from caesura.core.mesh.laplacian import Laplacian
from caesura.core.mesh.mesh import Mesh

MODES = 32
"""Eigenfunctions of a piece. exp(−λ t) of the last one is 1e-4 at the shortest time: the rest would add nothing."""

MOST_POINTS = 50_000
"""Beyond this the factorisation at rest takes more than ten seconds and some hundred MB."""

TIMES = 8
MOST_POINTS = 50_000
"""Beyond this the factorisation at rest takes more than ten seconds and some hundred MB."""

TIMES = 8
DENSE = 400
"""Points below which all eigenfunctions at once are quicker than the first few."""

AT_ONCE = 4
"""Frames whose Laplacians are held at once."""

SQUEEZED = 1e-6
"""The least area of a point in a frame, as a share of that at rest: what collapses stays finite."""


@dataclass(frozen=True)
class HeatKernel:
    """The change of the heat kernel signature of each triangle; no unit, from 0.

    O(points · MODES²) a frame: some 4 µs a point and half a millisecond a piece; a sparse factorisation at rest.
    """

    mesh: Mesh
    pieces: tuple["Piece", ...]
    at_rest: Float64[np.ndarray, "columns times 1"]
    thinness: float

    @classmethod
    def of(cls, mesh: Mesh) -> "HeatKernel":
        """The functions and times of every piece, at rest. Raises `LimitExceeded` above `MOST_POINTS`."""
        if len(mesh.members) > MOST_POINTS:
            raise LimitExceeded(
                "limit-exceeded",
                f"The mesh has {len(mesh.members)} points and heat-kernel takes at most {MOST_POINTS}."
                " Choose another descriptor, geodesic for example, or send a simpler mesh.",
                limit=MOST_POINTS,
                actual=len(mesh.members),
            )
        parts = tuple(_pieces(mesh))
        rest = _signatures(mesh, parts, mesh.rows_at_rest().astype(np.float64))
        whole = mesh.areas.sum()
        # A triangle's metric is off by δ over its height; heat feels the mean of that over its way.
        thinness = float(np.sum(mesh.areas * _per_height(mesh)) / whole)
        return cls(mesh, parts, mesh.on_triangles(slice(None), rest), thinness)

    @property
    def columns(self) -> int:
        """How many triangles there are."""
        return len(self.mesh.corners)

    def tiles(
        self, block: Float32[np.ndarray, "frames V 3"]
    ) -> Iterator[tuple[slice, Float32[np.ndarray, "n frames"]]]:
        """Columns, and the change of their signature in every frame of the block."""
        rows, change = self.mesh.rows(block), np.empty((self.columns, len(block)), np.float32)
        for first in range(0, len(block), AT_ONCE):  # in float64, a few frames: the whole block would fill the memory
            frames = slice(first, first + AT_ONCE)
            change[:, frames] = self._change(rows[:, :, frames].astype(np.float64))
        for columns in self.mesh.tiles():
            yield columns, change[columns]

    def _change(self, rows: Float64[np.ndarray, "P 3 frames"]) -> Float64[np.ndarray, "columns frames"]:
        now = self.mesh.on_triangles(slice(None), _signatures(self.mesh, self.pieces, rows))
        return np.asarray(np.sqrt(np.mean(np.log(now / self.at_rest) ** 2, axis=1)))

    def noise(self, reach: float) -> Float32[np.ndarray, "columns"]:
        """The change that rounding alone gives where coordinates go up to `reach`."""
        return np.full(self.columns, ROUNDING * reach * self.thinness, np.float32)


@dataclass(frozen=True)
class Piece:
    """A connected piece: which `points` it has, and its cotangent Laplacian.

    `modes` are its smoothest functions at rest, `slopes` their differences along each edge, `least` the smallest
    areas that count; `times` are when heat is looked at.
    """

    points: Int[np.ndarray, "p"]
    laplacian: Laplacian
    modes: Float64[np.ndarray, "p k"]
    slopes: Float64[np.ndarray, "E k"]
    least: Float64[np.ndarray, "p 1"]
    times: Float64[np.ndarray, "times"]

    @classmethod
    def of(
        cls, points: Int[np.ndarray, "p"], corners: Int[np.ndarray, "t 3"], place: Float64[np.ndarray, "p 3"]
    ) -> "Piece":
        """`corners` are numbers of the piece's own points, at `place` at rest."""
        laplacian = Laplacian.of(corners, len(points))
        weights, areas = laplacian.at(place[:, :, None])
        values, modes = laplacian.smoothest(weights[:, 0], areas[:, 0], MODES)
        last, first = np.maximum(values[[-1, 1]], np.finfo(float).tiny)
        times = 4 * np.log(10) / np.geomspace(last, first, TIMES)
        here, there = laplacian.edges.T
        return cls(points, laplacian, modes, modes[here] - modes[there], SQUEEZED * areas, times)

    def signature(self, place: Float64[np.ndarray, "p 3 frames"]) -> Float64[np.ndarray, "p times frames"]:
        """h_t of every point, per area."""
        weights, areas = self.laplacian.at(place)
        areas = np.maximum(areas, self.least)
        found = np.empty((len(place), len(self.times), place.shape[2]))
        for frame in range(place.shape[2]):
            stiffness = self.slopes.T @ (weights[:, frame, None] * self.slopes)
            mass = self.modes.T @ (areas[:, frame, None] * self.modes)
            values, turn = eigh(stiffness, mass)
            decay = np.exp(-np.outer(np.maximum(values, 0), self.times))
            found[:, :, frame] = (self.modes @ turn) ** 2 @ decay
        return found


def _pieces(mesh: Mesh) -> Iterator[Piece]:
    edges, _ = list_edges(mesh.corners)
    points = len(mesh.members)
    piece = label_connected_pieces(edges, points)
    count = int(piece.max()) + 1
    place = mesh.rest.astype(np.float64)
    local, of_triangle = np.empty(points, np.int64), piece[mesh.corners[:, 0]]
    members = np.split(np.argsort(piece, kind="stable"), np.cumsum(np.bincount(piece, minlength=count))[:-1])
    sorted_triangles = np.argsort(of_triangle, kind="stable")
    triangles = np.split(sorted_triangles, np.cumsum(np.bincount(of_triangle, minlength=count))[:-1])
    for inside, faces in zip(members, triangles, strict=True):
        local[inside] = np.arange(len(inside))
        yield Piece.of(inside, local[mesh.corners[faces]], place[inside])


def _signatures(
    mesh: Mesh, pieces: tuple[Piece, ...], rows: Float64[np.ndarray, "P 3 frames"]
) -> Float64[np.ndarray, "P times frames"]:
    found = np.empty((len(mesh.members), TIMES, rows.shape[2]))
    for piece in pieces:
        found[piece.points] = piece.signature(rows[piece.points])
    return found


def _per_height(mesh: Mesh) -> Float64[np.ndarray, "columns"]:
    """One over the least height of every triangle."""
    a, b, c = mesh.rest.astype(np.float64)[mesh.corners.T]
    longest = np.max([np.linalg.norm(u - v, axis=1) for u, v in ((a, b), (b, c), (c, a))], axis=0)
    return np.asarray(longest / (2 * mesh.areas))
