"""Refinement: windows blur a cut by up to half their length; single frames say where it is, and how clearly."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.kernels import switching
from caesura.core.methods.switching.window_statistics import compute_speeds

REACH_SECONDS = 0.5
"""A window of a second and a half knows a cut no worse than that; people change motion gradually, and over longer the
frames between two motions are like neither."""
GUARD_SECONDS = 0.75
"""So near to a cut a frame is no example of its motion."""
NEAREST = 5
EXAMPLES = 600
SPEED_WEIGHT = 0.5
BESIDE_SECONDS = 0.3
"""Of frames on each side of a cut that tell how clear its place is."""
DIRECTIONS = 30
"""Of poses and speeds together; the rest only costs time."""


@dataclass(frozen=True)
class Refinement:
    """What single frames of a take are compared by: poses and speeds, in the directions in which they vary most."""

    poses: Float[np.ndarray, "frames D"]
    frame_rate: float

    @classmethod
    def of(cls, values: tuple[Float[np.ndarray, "frames _"], ...], frame_rate: float) -> "Refinement":
        """Of descriptors."""
        return cls(poses_and_speeds(values, frame_rate), frame_rate)

    def moved(self, labels: Int[np.ndarray, "frames"]) -> Int[np.ndarray, "frames"]:
        """Every cut moved within half a second to where the frames before it are most like the motion before it, and
        those after it like the one after.

        How unlike a frame is to a motion is its mean distance to the 5 nearest of that motion's frames (at most 600,
        none near a cut). No segment is lost: a cut moves at most halfway to its neighbours.
        """
        cuts = np.flatnonzero(np.diff(labels)) + 1
        if len(cuts) == 0 or self.poses.shape[1] == 0:
            return labels
        moved = [
            first if len(before) == 0 else first + int(np.concatenate([[0.0], np.cumsum(before - after)]).argmin())
            for first, before, after in self._beside(labels, cuts)
        ]
        lengths = np.diff(np.concatenate([[0], moved, [len(labels)]]))
        return np.asarray(np.repeat(labels[np.concatenate([[0], cuts])], lengths))

    def clearness(self, labels: Int[np.ndarray, "frames"]) -> Float[np.ndarray, "cuts"]:
        """For every cut, 0 to 1: what moving it would cost, by the frames within 0.3 s of it."""
        cuts = np.flatnonzero(np.diff(labels)) + 1
        if self.poses.shape[1] == 0:
            return np.ones(len(cuts))
        beside = max(round(BESIDE_SECONDS * self.frame_rate), 1)
        found = np.zeros(len(cuts))
        for i, (first, before, after) in enumerate(self._beside(labels, cuts)):
            at = int(cuts[i]) - first
            left, right = slice(max(at - beside, 0), at), slice(at, at + beside)
            if len(before):
                found[i] = min(_clearness(before[left], after[left]), _clearness(after[right], before[right]))
        return found

    def _beside(
        self, labels: Int[np.ndarray, "frames"], cuts: Int[np.ndarray, "cuts"]
    ) -> Iterator[tuple[int, Float[np.ndarray, "some"], Float[np.ndarray, "some"]]]:
        """For every cut the first frame to which it may move, and how unlike frames from there are to either motion.

        No frames where it may not move: then the first is the cut.
        """
        examples = _examples(self.poses, labels, cuts, round(GUARD_SECONDS * self.frame_rate))
        reach = max(round(REACH_SECONDS * self.frame_rate), 1)
        bounds = np.concatenate([[0], cuts, [len(labels)]])
        for i, cut in enumerate(cuts.tolist()):
            first = max(cut - reach, (int(bounds[i]) + cut) // 2 + 1)
            last = min(cut + reach, (cut + int(bounds[i + 2])) // 2)
            if first >= last:
                yield cut, _NONE, _NONE
            else:
                before = _distance_to_examples(self.poses[first:last], examples[int(labels[cut - 1])])
                yield first, before, _distance_to_examples(self.poses[first:last], examples[int(labels[cut])])


def poses_and_speeds(
    values: tuple[Float[np.ndarray, "frames _"], ...], frame_rate: float
) -> Float[np.ndarray, "frames D"]:
    """Every descriptor and its speed, each at unit mean square but speeds at half of it, in leading directions."""
    parts = []
    for value in values:
        centred = value - value.mean(axis=0, dtype=np.float64)
        for part, weight in ((centred, 1.0), (compute_speeds(centred, frame_rate), SPEED_WEIGHT)):
            square = float(np.einsum("fd,fd->", part, part)) / len(part)
            if square > 0:
                parts.append(part * (weight / np.sqrt(square)))
    if not parts:
        return np.zeros((len(values[0]) if values else 0, 0), np.float32)
    together = np.concatenate(parts, axis=1)
    together -= together.mean(axis=0)
    _, directions = np.linalg.eigh(together.T @ together)
    return np.asarray(together @ directions[:, ::-1][:, :DIRECTIONS], np.float32)


def _examples(
    poses: Float[np.ndarray, "frames D"], labels: Int[np.ndarray, "frames"], cuts: Int[np.ndarray, "cuts"], guard: int
) -> dict[int, Float[np.ndarray, "D examples"]]:
    """Frames of every motion, evenly chosen from those at least `guard` from a cut, or the middle thirds."""
    bounds = np.concatenate([[0], cuts, [len(labels)]])
    inside = np.zeros(len(labels), bool)
    for start, stop in zip(bounds[:-1].tolist(), bounds[1:].tolist(), strict=True):
        margin = min(guard, (stop - start) // 3)
        inside[start + margin if start else start : stop - margin if stop < len(labels) else stop] = True
    found = {}
    for motion in np.unique(labels).tolist():
        frames = np.flatnonzero(inside & (labels == motion))
        chosen = np.linspace(0, len(frames) - 1, min(len(frames), EXAMPLES)).astype(np.int64)
        found[motion] = np.ascontiguousarray(poses[frames[chosen]].T)
    return found


def _clearness(own: Float[np.ndarray, "some"], other: Float[np.ndarray, "some"]) -> float:
    """1 − (unlikeness to their own motion / to the other)² of the frames on one side of a cut, at least 0.

    Without such frames, at the end of a cut's reach, nothing is known: 0 frames are unlike nothing.
    """
    if len(own) == 0:
        return 1.0
    return float(max(1 - (own.sum() / max(other.sum(), _TINY)) ** 2, 0.0))


_TINY = float(np.finfo(np.float64).tiny)
_NONE = np.zeros(0)


def _distance_to_examples(
    poses: Float[np.ndarray, "some D"], examples: Float[np.ndarray, "D examples"]
) -> Float[np.ndarray, "some"]:
    """Mean distance to the nearest examples."""
    distances = np.empty(len(poses))
    switching.distances_to_nearest(poses, examples, min(NEAREST, examples.shape[1]), distances)
    return distances
