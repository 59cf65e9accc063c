"""The cotangent Laplacian of a mesh: how heat flows along its edges (Pinkall and Polthier 1993)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float64, Int
from scipy.linalg import eigh
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import eigsh

from caesura.core.mesh.edges import list_edges

DENSE = 400
"""Points below which all eigenfunctions at once are quicker than the first few."""

SQUEEZED = 1e-6
"""The least height of a triangle, as a share of its size: the cotangents of what collapses stay finite."""


@dataclass(frozen=True)
class Laplacian:
    """L φ = λ A φ on the points of one piece. `corners` and `edges` are what is connected, in every frame alike.

    `opposite` adds to each edge what the angles across from it say, `around` to each point the areas around it.
    """

    corners: Int[np.ndarray, "t 3"]
    edges: Int[np.ndarray, "E 2"]
    opposite: csr_array
    around: csr_array

    @classmethod
    def of(cls, corners: Int[np.ndarray, "t 3"], points: int) -> "Laplacian":
        """The Laplacian of a mesh whose shape is not yet known."""
        edges, which = list_edges(corners)
        return cls(corners, edges, _sums(which, len(edges), 1 / 2), _sums(corners, points, 1 / 3))

    def at(
        self, place: Float64[np.ndarray, "p 3 frames"]
    ) -> tuple[Float64[np.ndarray, "E frames"], Float64[np.ndarray, "p frames"]]:
        """The weight of every edge, ½ Σ cot of the angles across (no unit), and the area around every point."""
        a, b, c = (place[side] for side in self.corners.T)
        corners = ((b - a, c - a), (c - b, a - b), (a - c, b - c))
        doubled = np.linalg.norm(np.cross(b - a, c - a, axis=1), axis=1)
        size = sum(np.einsum("tcf,tcf->tf", side, side) for side, _ in corners)
        height = np.maximum(doubled, SQUEEZED * size + np.finfo(np.float32).tiny)
        cotangents = np.stack([np.einsum("tcf,tcf->tf", *sides) / height for sides in corners], axis=1)
        weights = self.opposite @ cotangents.reshape(-1, place.shape[2])
        return weights, self.around @ np.repeat(doubled / 2, 3, axis=0)

    def smoothest(
        self, weights: Float64[np.ndarray, "E"], areas: Float64[np.ndarray, "p"], count: int
    ) -> tuple[Float64[np.ndarray, "k"], Float64[np.ndarray, "p k"]]:
        """At most `count` least eigenvalues, ascending, per area, and their functions, orthonormal by area."""
        points, count = len(areas), min(count, len(areas))
        here, there = np.concatenate([self.edges, self.edges[:, ::-1]]).T
        beside = csr_array((np.tile(weights, 2), (here, there)), shape=(points, points))
        stiffness = diags_array(np.asarray(beside.sum(axis=1))) - beside
        if points <= DENSE:
            values, modes = eigh(stiffness.toarray(), np.diag(areas), subset_by_index=(0, count - 1))
            return values, modes
        begin = np.random.default_rng(0).normal(size=points)  # fixed: the functions belong to the body
        below = -1 / areas.sum()  # of the size of the first eigenvalues, so that what is factorised is definite
        values, modes = eigsh(stiffness.tocsc(), count, diags_array(areas).tocsc(), sigma=below, v0=begin)
        order = np.argsort(values, kind="stable")
        return values[order], modes[:, order]


def _sums(which: Int[np.ndarray, "t 3"], count: int, weight: float) -> csr_array:
    """Adds, times `weight`, three values a triangle to what each belongs to."""
    flat = which.ravel()
    return csr_array((np.full(len(flat), weight), (flat, np.arange(len(flat)))), shape=(count, len(flat)))
