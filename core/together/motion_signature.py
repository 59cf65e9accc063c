"""Motion signatures: what a stretch of motion is like, whatever its speed, its phase and how often it is repeated.

Three moments of the poses in a stretch: their mean, the square root of their covariance, and that of the covariance
of their speeds. None of them asks in which order or how evenly the poses follow each other: two stretches of one
motion are alike when one is bent in time onto the other, but for the speeds, which count a third.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32, Int

WEIGHTS = (0.5, 1.0, 1.0)
"""Of the mean pose, of the poses about it, and of the speeds. A stance differs from person to person more than a motion
does, so it counts half."""
MIRROR_PENALTY = 0.05
"""A motion of the other side is the same motion, and a little less so."""
EDGE_SECONDS = 0.15
"""So near to a cut a motion is not yet, or no longer, itself."""


@dataclass(frozen=True)
class MotionSignatures:
    """`means` (n, d), `poses` and `speeds` (n, d, d), the roots of two covariances: one row for every stretch."""

    means: Float32[np.ndarray, "n d"]
    poses: Float32[np.ndarray, "n d d"]
    speeds: Float32[np.ndarray, "n d d"]

    def __len__(self) -> int:
        return len(self.means)

    def __getitem__(self, chosen: "Int[np.ndarray, 'some'] | slice") -> "MotionSignatures":
        return MotionSignatures(self.means[chosen], self.poses[chosen], self.speeds[chosen])

    @classmethod
    def of(
        cls,
        track: Float32[np.ndarray, "steps d"],
        speeds: Float32[np.ndarray, "steps d"],
        rate: float,
        ranges: Int[np.ndarray, "n 2"],
    ) -> "MotionSignatures":
        """Of ranges of steps [start, end) of one take, at `rate` steps a second."""
        edge = max(int(EDGE_SECONDS * rate), 1)
        directions = track.shape[1]
        means = np.zeros((len(ranges), directions), np.float32)
        moments = np.zeros((2, len(ranges), directions, directions))
        for i, (start, end) in enumerate(ranges.tolist()):
            inner = slice(start + edge, end - edge) if end - start > 4 * edge else slice(start, max(end, start + 1))
            values, moving = track[inner].astype(np.float64), speeds[inner].astype(np.float64)
            means[i] = values.mean(axis=0)
            about = values - values.mean(axis=0)
            moments[0, i], moments[1, i] = about.T @ about / len(about), moving.T @ moving / len(moving)
        roots = matrix_roots(moments).astype(np.float32)
        return cls(means, roots[0], roots[1])

    @classmethod
    def joined(cls, parts: "list[MotionSignatures]") -> "MotionSignatures":
        """All of several, one after the other."""
        return cls(
            np.concatenate([part.means for part in parts]),
            np.concatenate([part.poses for part in parts]),
            np.concatenate([part.speeds for part in parts]),
        )

    def spreads(self) -> Float[np.ndarray, "3"]:
        """How far the stretches are from their mean, for each of the three moments, squared; 1 where all are alike."""
        found = []
        for values in (self.means, self.poses, self.speeds):
            rows = values.reshape(len(values), -1).astype(np.float64)
            square = float(((rows - rows.mean(axis=0)) ** 2).sum(axis=1).mean())
            found.append(square if square > 0 else 1.0)
        return np.array(found)

    def distances(
        self,
        others: "MotionSignatures",
        spreads: Float[np.ndarray, "3"],
        signs: Float[np.ndarray, "d"],
    ) -> Float[np.ndarray, "n m"]:
        """How unlike each stretch is to each of the others, squared; about 2 for two stretches at random.

        The lesser of the distance as performed and, for a penalty, of that to the mirrored other.
        """
        straight, mirrored = np.zeros((2, len(self), len(others)))
        both = np.outer(signs, signs).astype(np.float32)
        turned = (signs.astype(np.float32), both, both)
        mine, theirs = (self.means, self.poses, self.speeds), (others.means, others.poses, others.speeds)
        for one, other, sign, weight, spread in zip(mine, theirs, turned, WEIGHTS, spreads.tolist(), strict=True):
            share = weight / sum(WEIGHTS) / spread
            straight += share * _squared_distances(one, other)
            mirrored += share * _squared_distances(one, other * sign)
        if (signs > 0).all():
            return straight
        return np.minimum(straight, mirrored + MIRROR_PENALTY)


def matrix_roots(matrices: Float[np.ndarray, "*n d d"]) -> Float[np.ndarray, "*n d d"]:
    """The symmetric square roots of symmetric matrices without negative eigenvalues."""
    values, vectors = np.linalg.eigh(matrices)
    return np.asarray((vectors * np.sqrt(np.maximum(values, 0.0))[..., None, :]) @ np.swapaxes(vectors, -1, -2))


def _squared_distances(one: Float32[np.ndarray, "n *rest"], other: Float32[np.ndarray, "m *rest"]) -> np.ndarray:
    a, b = one.reshape(len(one), -1).astype(np.float64), other.reshape(len(other), -1).astype(np.float64)
    squares = np.einsum("nd,nd->n", a, a)[:, None] + np.einsum("md,md->m", b, b)[None, :] - 2 * a @ b.T
    return np.asarray(np.maximum(squares, 0.0))
