"""The angles of a mesh, at its points and across its edges: what curvature is made of."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Float64, Int

from caesura.core.descriptors.strain import TILE
from caesura.core.kernels import descriptors
from caesura.core.mesh.edges import list_edges
from caesura.core.mesh.mesh import Mesh

Rows = Float32[np.ndarray, "P 3 frames"]
Totals = Float32[np.ndarray, "P frames"]


@dataclass(frozen=True)
class AngleDefect:
    """What the angles around each point lack of `full`: 2π, or π on a border."""

    corners: Int[np.ndarray, "columns 3"]
    full: Float32[np.ndarray, "P"]

    @classmethod
    def of(cls, mesh: Mesh) -> "AngleDefect":
        """A point is on a border where one of its edges has a single triangle."""
        edges, which = list_edges(mesh.corners)
        border = edges[np.bincount(which.ravel(), minlength=len(edges)) == 1]
        full = np.full(len(mesh.members), 2 * np.pi, np.float32)
        full[border.ravel()] = np.pi
        return cls(mesh.corners, full)

    def total(self, rows: Rows) -> Totals:
        """K A of every point and frame, in radians; the angle at a corner that coincides with another is 0."""
        defect = np.repeat(self.full[:, None], rows.shape[2], axis=1)
        for start in range(0, len(self.corners), TILE):
            corners = self.corners[start : start + TILE]
            for turn in range(3):
                at, left, right = np.roll(corners, turn, axis=1).T
                u, v = rows[left] - rows[at], rows[right] - rows[at]
                # arctan2 keeps its digits where arccos of the cosine loses them: in slivers.
                angle = np.arctan2(_length(_cross(u, v)), _dot(u, v))
                _add(-angle, at, defect)
        return defect

    def rounding(self, mesh: Mesh) -> Float64[np.ndarray, "P"]:
        """The square of what the rounding of places, by 1, adds to each defect: an angle turns by both its sides."""
        place, squared = mesh.rest.astype(np.float64), np.zeros(len(mesh.members))
        for turn in range(3):
            at, left, right = np.roll(mesh.corners, turn, axis=1).T
            for end in (left, right):
                np.add.at(squared, at, 1 / np.sum((place[end] - place[at]) ** 2, axis=1))
        return squared


@dataclass(frozen=True)
class FoldAngles:
    """How far the two triangles at each hinge are folded against each other."""

    hinges: Int[np.ndarray, "hinges 4"]

    def total(self, rows: Rows) -> Totals:
        """H A of every point and frame, in units of length; outward folds are positive where triangles wind so."""
        folds = np.zeros((len(rows), rows.shape[2]), np.float32)
        for start in range(0, len(self.hinges), TILE):
            a, b, c, d = self.hinges[start : start + TILE].T
            edge, up, down = rows[b] - rows[a], rows[c] - rows[a], rows[d] - rows[a]
            first, second = _cross(edge, up), _cross(down, edge)
            length = _length(edge)
            angle = np.arctan2(-length * _dot(first, down), _dot(first, second))
            share = length * angle / np.float32(4)
            _add(share, a, folds)
            _add(share, b, folds)
        return folds

    def rounding(self, mesh: Mesh) -> Float64[np.ndarray, "P"]:
        """The square of what the rounding of places, by 1, adds to each total: a fold turns by both heights."""
        a, b, c, d = mesh.rest.astype(np.float64)[self.hinges.T]
        squared = np.zeros(len(mesh.members))
        length = np.linalg.norm(b - a, axis=1)
        for far in (c, d):
            twice = np.linalg.norm(np.cross(b - a, far - a), axis=1)
            for end in self.hinges[:, :2].T:
                np.add.at(squared, end, (length**2 / twice / 4) ** 2)
        return squared


def _add(values: Float32[np.ndarray, "n frames"], points: Int[np.ndarray, "n"], totals: Totals) -> None:
    ones = np.ones(len(values), np.float32)
    descriptors.add_weighted(values, ones, points.astype(np.int32), totals)


def _dot(u: Float32[np.ndarray, "n 3 frames"], v: Float32[np.ndarray, "n 3 frames"]) -> np.ndarray:
    return np.asarray(u[:, 0] * v[:, 0] + u[:, 1] * v[:, 1] + u[:, 2] * v[:, 2])


def _cross(u: Float32[np.ndarray, "n 3 frames"], v: Float32[np.ndarray, "n 3 frames"]) -> np.ndarray:
    return np.asarray(np.cross(u, v, axis=1))


def _length(u: Float32[np.ndarray, "n 3 frames"]) -> np.ndarray:
    return np.asarray(np.sqrt(_dot(u, u)))
