"""Pair distances: how far points of the body are from each other, against the rest shape.

Rigid motion of the whole body cancels, and a body made of rigid parts, whose triangles never strain, shows its
motion all the same. The pairs are chosen once, from the rest shape alone.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int, Int32

from caesura.core.frames.vertex_rows import gather_rows
from caesura.core.kernels import descriptors
from caesura.core.mesh.farthest_points import sample_farthest_points

POINTS = 150
NEAREST = 10
PAIRS = 600


@dataclass(frozen=True)
class PairDistances:
    """Pairs of vertices, their distances at rest, and the size of the body (the largest distance of two points)."""

    first: Int[np.ndarray, "pairs"]
    second: Int[np.ndarray, "pairs"]
    at_rest: Float[np.ndarray, "pairs"]
    size: float

    @classmethod
    def of(cls, rest: Float[np.ndarray, "V 3"], triangles: Int[np.ndarray, "T 3"]) -> "PairDistances":
        """About `PAIRS` pairs among `POINTS` points spread over the rest shape: half of them neighbours, half any two.

        Only vertices that some triangle uses are chosen, or all where there is no triangle. Neighbours follow
        the bending of a limb, distant pairs the pose. A body of a single point has no pair.
        """
        used = np.zeros(len(rest), bool)
        used[triangles.ravel() if len(triangles) else slice(None)] = True
        points = sample_farthest_points(rest, POINTS, used).chosen
        place = rest[points].astype(np.float64)
        distance = np.linalg.norm(place[:, None] - place[None, :], axis=2)
        a, b = _pairs(distance)
        return cls(points[a], points[b], distance[a, b].astype(np.float32), float(distance.max()))

    def measure(self, block: Float[np.ndarray, "frames V 3"]) -> Float[np.ndarray, "frames pairs"]:
        """(distance − distance at rest) / size, float32, no unit: zero for a body that only moves rigidly."""
        members, first, second = self._ends
        rows = np.empty((len(members), 3, len(block)), np.float32)
        gather_rows(block, members, rows)
        changes = np.empty((len(first), len(block)), np.float32)
        descriptors.pair_changes(rows, first, second, self.at_rest, np.float32(1 / (self.size or 1.0)), changes)
        return changes.T

    @cached_property
    def _ends(self) -> tuple[Int32[np.ndarray, "n"], Int32[np.ndarray, "pairs"], Int32[np.ndarray, "pairs"]]:
        """The vertices that are in any pair, and both ends of every pair among them."""
        members, place = np.unique(np.concatenate([self.first, self.second]), return_inverse=True)
        first, second = place.astype(np.int32).reshape(2, -1)
        return members.astype(np.int32), first, second


def _pairs(distance: Float[np.ndarray, "n n"]) -> tuple[Int[np.ndarray, "pairs"], Int[np.ndarray, "pairs"]]:
    """At most `PAIRS` different pairs a < b: all where there are no more, else near ones and any, in equal parts."""
    n = len(distance)
    a, b = np.triu_indices(n, 1)
    if len(a) <= PAIRS:
        return a, b
    order = np.argsort(distance, axis=1, kind="stable")[:, 1 : NEAREST + 1]
    near = np.zeros((n, n), bool)
    near[np.arange(n)[:, None], order] = True
    is_near = (near | near.T)[a, b]
    draw = np.random.default_rng(0)  # fixed: the pairs belong to the body, not to the person's seed
    neighbours = draw.permutation(np.flatnonzero(is_near))[: PAIRS // 2]
    others = draw.permutation(np.flatnonzero(~is_near))[: PAIRS - len(neighbours)]
    chosen = np.sort(np.concatenate([neighbours, others]))
    return a[chosen], b[chosen]
