"""Refinement: windows blur a cut by up to half their length; single frames say where it is, and how clearly."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Features
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
DISAGREEMENT = 0.5
"""How much of its clearness a cut loses that single frames put as far from where windows saw it as they may."""


@dataclass(frozen=True)
class RefinedCuts:
    """Labels of the frames, and for every cut, 0 to 1, how clear its place is: what moving it would cost."""

    labels: Int[np.ndarray, "frames"]
    clearness: Float[np.ndarray, "cuts"]


def refine_cuts(labels: Int[np.ndarray, "frames"], features: tuple[Features, ...], frame_rate: float) -> RefinedCuts:
    """Every cut moved within half a second to where the frames before it are most like the motion before it, and those
    after it like the one after.

    How unlike a frame is to a motion is its mean distance to the 5 nearest of that motion's frames (at most 600, none
    near a cut). No segment is lost: a cut moves at most halfway to its neighbours.
    """
    cuts = np.flatnonzero(np.diff(labels)) + 1
    poses = poses_and_speeds(features, frame_rate)
    if len(cuts) == 0 or poses.shape[1] == 0:
        return RefinedCuts(labels, np.ones(len(cuts)))
    examples = _examples(poses, labels, cuts, round(GUARD_SECONDS * frame_rate))
    reach, beside = (max(round(seconds * frame_rate), 1) for seconds in (REACH_SECONDS, BESIDE_SECONDS))
    moved, clearness = _move_cut(poses, labels, cuts, examples, reach, beside)
    bounds = np.concatenate([[0], cuts])
    lengths = np.diff(np.concatenate([[0], moved, [len(labels)]]))
    return RefinedCuts(np.repeat(labels[bounds], lengths), clearness)


def poses_and_speeds(features: tuple[Features, ...], frame_rate: float) -> Float[np.ndarray, "frames D"]:
    """Every descriptor and its speed, side by side, each at unit mean square but speeds at half of it."""
    parts = []
    for feature in features:
        values = feature.values.astype(np.float64)
        for part, weight in ((values - values.mean(axis=0), 1.0), (compute_speeds(values, frame_rate), SPEED_WEIGHT)):
            square = float(np.einsum("fd,fd->", part, part)) / len(part)
            if square > 0:
                parts.append((part * (weight / np.sqrt(square))).astype(np.float32))
    frames = len(features[0].values) if features else 0
    return np.concatenate(parts, axis=1) if parts else np.zeros((frames, 0), np.float32)


def _examples(
    poses: Float[np.ndarray, "frames D"], labels: Int[np.ndarray, "frames"], cuts: Int[np.ndarray, "cuts"], guard: int
) -> dict[int, Float[np.ndarray, "examples D"]]:
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
        found[motion] = poses[frames[chosen]]
    return found


def _move_cut(
    poses: Float[np.ndarray, "frames D"],
    labels: Int[np.ndarray, "frames"],
    cuts: Int[np.ndarray, "cuts"],
    examples: dict[int, Float[np.ndarray, "examples D"]],
    reach: int,
    beside: int,
) -> tuple[Int[np.ndarray, "cuts"], Float[np.ndarray, "cuts"]]:
    """The best place of each cut, within reach and at most halfway to the cuts beside it; and how clear it is."""
    bounds = np.concatenate([[0], cuts, [len(labels)]])
    moved, clearness = cuts.copy(), np.zeros(len(cuts))
    for i, cut in enumerate(cuts.tolist()):
        first = max(cut - reach, (int(bounds[i]) + cut) // 2 + 1)
        last = min(cut + reach, (cut + int(bounds[i + 2])) // 2)
        if first >= last:
            continue
        before = _distance_to_examples(poses[first:last], examples[int(labels[cut - 1])])
        after = _distance_to_examples(poses[first:last], examples[int(labels[cut])])
        cost = np.concatenate([[0.0], np.cumsum(before - after)])
        best = int(cost.argmin())
        moved[i] = first + best
        left, right = slice(max(best - beside, 0), best), slice(best, best + beside)
        agreed = 1 - DISAGREEMENT * abs(int(moved[i]) - cut) / reach
        clearness[i] = agreed * min(_clearness(before[left], after[left]), _clearness(after[right], before[right]))
    return moved, clearness


def _clearness(own: Float[np.ndarray, "some"], other: Float[np.ndarray, "some"]) -> float:
    """1 − (unlikeness to their own motion / to the other)² of the frames on one side of a cut, at least 0.

    Without such frames, at the end of a cut's reach, nothing is known: 0 frames are unlike nothing.
    """
    if len(own) == 0:
        return 1.0
    return float(max(1 - (own.sum() / max(other.sum(), _TINY)) ** 2, 0.0))


_TINY = float(np.finfo(np.float64).tiny)


def _distance_to_examples(
    poses: Float[np.ndarray, "some D"], examples: Float[np.ndarray, "examples D"]
) -> Float[np.ndarray, "some"]:
    """Mean distance to the nearest examples."""
    square = np.einsum("fd,fd->f", poses, poses)[:, None] + np.einsum("ed,ed->e", examples, examples)
    distance = np.sqrt(np.maximum(square - 2 * poses @ examples.T, 0.0))
    nearest = min(NEAREST, distance.shape[1])
    return np.asarray(np.partition(distance, nearest - 1, axis=1)[:, :nearest].mean(axis=1, dtype=np.float64))
