"""Points spread evenly over a shape, each one as far from those before it as the shape allows."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int


@dataclass(frozen=True)
class FarthestPoints:
    """Indices of the `chosen` points, and which of them (by rank) is nearest to each point."""

    chosen: Int[np.ndarray, "chosen"]
    nearest: Int[np.ndarray, "points"]


def sample_farthest_points(
    points: Float[np.ndarray, "points 3"], count: int, eligible: Bool[np.ndarray, "points"]
) -> FarthestPoints:
    """At most `count` of the `eligible` points, by farthest-point sampling (Gonzalez 1985), and who is nearest to whom.

    The first is the eligible point farthest from their mean; ties go to the lower index, so that the choice is the
    same everywhere. Stops early where every eligible point coincides with a chosen one. O(count · points), with
    O(points) memory. Raises ValueError where no point is eligible.
    """
    if not eligible.any():
        raise ValueError("no point is eligible")
    centred = points - points[eligible].mean(axis=0, dtype=np.float64)
    columns = np.ascontiguousarray(centred.T, dtype=np.float32)
    distance = np.full(len(points), np.inf, np.float32)
    nearest = np.zeros(len(points), np.int64)
    chosen: list[int] = []
    candidate = int(np.argmax(np.where(eligible, _squared(columns, np.zeros(3, np.float32)), -1)))
    while len(chosen) < count and distance[candidate] > 0:
        to_candidate = _squared(columns, columns[:, candidate])
        nearest[to_candidate < distance] = len(chosen)
        np.minimum(distance, to_candidate, out=distance)
        chosen.append(candidate)
        candidate = int(np.argmax(np.where(eligible, distance, -1)))
    return FarthestPoints(np.array(chosen, np.int64), nearest)


def _squared(columns: Float[np.ndarray, "3 points"], origin: Float[np.ndarray, "3"]) -> Float[np.ndarray, "points"]:
    x, y, z = columns - origin[:, None]
    return np.asarray(x * x + y * y + z * z, np.float32)
