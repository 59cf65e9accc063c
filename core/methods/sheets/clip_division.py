"""Division: a sheet cut into its clips.

A clip that goes round ends in the pose in which it begins; at a cut the pose or its speed jumps; and two clips differ
in what moves, and how far. The division of least cost by all three is found exactly, by dynamic programming.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Float32, Float64, Int

from caesura.core.analysis import Analysis
from caesura.core.kernels import sheets
from caesura.core.methods.pose_features import pose_features

SAMPLES_PER_SECOND = 30.0
DIRECTIONS = 12
SHORTEST_SECONDS, LONGEST_SECONDS = 0.3, 15.0
LONGEST_GAP_SECONDS = 2.0
"""Frames between two clips that belong to neither, in which the figure goes from one to the next."""
GAP = 0.5
GAP_PER_SECOND = 0.6
CLIP = 1.5
"""What every clip costs, in units of the logarithm of how far it is from closing."""
ROUNDING = 0.1
"""Of the distance at the usual speed: nearer than that a clip is closed."""
SPREAD = 0.09
"""Weight of the variances within a clip, against those of the whole take, for each second."""
FLOOR = 1e-3
JUMP = 0.5
ARC = 0.1
"""A stretch is the way from one clip to the next where it strays so little from one cubic, as a spline draws it between
two keys. Such ways in drawn sheets stray .01 to .08, clips .14 and more."""
MOST_SAMPLES = 20_000
"""Eleven minutes: no timeline of clips is longer, and time and memory stay small."""


@dataclass(frozen=True)
class Division:
    """Clips [starts, ends) in frames, what each cut gains, and how far each clip is from closing."""

    starts: Int[np.ndarray, "clips"]
    ends: Int[np.ndarray, "clips"]
    gains: Float[np.ndarray, "cuts"]
    openness: Float[np.ndarray, "clips"]


@dataclass(frozen=True)
class Timeline:
    """The poses of a take at about 30 samples a second, and what every possible clip of it costs.

    `speed` is the distance that the pose usually moves in a sample. `reward[s]`: what a cut at sample s earns by its
    jump.
    """

    poses: Float64[np.ndarray, "samples d"]
    speed: float
    costs: Float32[np.ndarray, "samples lengths"]
    reward: Float[np.ndarray, "samples"]
    stride: int
    frames: int

    @classmethod
    def of(cls, analysis: Analysis) -> "Timeline | None":
        """None where nothing moves, or where the take is too short or too long for a sheet."""
        stride = max(round(analysis.frame_rate / SAMPLES_PER_SECOND), 1)
        leading = _leading(pose_features(analysis.features)[::stride].astype(np.float64))
        samples_per_second = analysis.frame_rate / stride
        shortest = max(round(SHORTEST_SECONDS * samples_per_second), 2)
        steps = np.linalg.norm(np.diff(leading, axis=0), axis=1)
        if not 2 * shortest <= len(leading) <= MOST_SAMPLES or not (steps > 0).any():
            return None
        moving = steps[steps > _STILL * steps.max()]
        speed = float(np.median(moving)) * samples_per_second / SAMPLES_PER_SECOND
        longest = min(round(LONGEST_SECONDS * samples_per_second), len(leading))
        costs = np.empty((len(leading), longest + 1), np.float32)
        sums = np.zeros((len(leading) + 1, leading.shape[1]))
        squares = np.zeros(sums.shape)
        np.cumsum(leading, axis=0, out=sums[1:])
        np.cumsum(np.square(leading), axis=0, out=squares[1:])
        weight = SPREAD / samples_per_second
        sheets.clip_costs(leading, sums, squares, speed, ROUNDING, weight, FLOOR, shortest, costs)
        return cls(leading, speed, costs, _jumps(steps / speed), stride, analysis.frames)

    def without_arcs(self, division: Division) -> "Timeline":
        """The same, but that no clip lies by half or more where one of this division, not the first, is an arc."""
        costs = self.costs.copy()
        lengths = np.arange(costs.shape[1])
        for start, end in zip(division.starts[1:] // self.stride, division.ends[1:] // self.stride, strict=True):
            if end - start <= LONGEST_GAP_SECONDS * SAMPLES_PER_SECOND and _strays(self.poses[start:end]) < ARC:
                for s in range(max(2 * start - end, 1), end):
                    inside = np.minimum(s + lengths, end) - max(s, start)
                    costs[s, 2 * inside >= lengths] = np.inf
        return replace(self, costs=costs)

    def divided(self, clips: int | None = None) -> Division:
        """The cheapest division into so many clips, or as near to that as their lengths allow; or into any number."""
        samples, shortest = len(self.poses), int(np.isfinite(self.costs[0]).argmax())
        between = np.arange(round(LONGEST_GAP_SECONDS * SAMPLES_PER_SECOND) + 1, dtype=np.float64)
        gap = GAP + GAP_PER_SECOND / SAMPLES_PER_SECOND * between
        lengths: list[Int[np.ndarray, "ends"]] = []
        gaps: list[Int[np.ndarray, "ends"]] = []
        before = np.full(samples + 1, np.inf)
        before[0] = 0.0
        reached = -1
        for i in range(samples // shortest):
            lengths.append(np.zeros(samples + 1, np.int16))
            gaps.append(np.zeros(samples + 1, np.int16))
            total = sheets.divide(self.costs, self.reward, gap, CLIP, before, lengths[i], gaps[i], clips is None)
            reached = i if np.isfinite(total) else reached
            if reached >= 0 and (clips is None or i + 1 >= clips):
                break
        return self._traced(lengths, gaps, None if clips is None else reached)

    def best_splits(self, division: Division) -> tuple[Int[np.ndarray, "clips"], Float[np.ndarray, "clips"]]:
        """For every clip the frame at which it would best be two, and what that gains; 0 where no two fit."""
        frames, gains = np.zeros(len(division.starts), np.int64), np.zeros(len(division.starts))
        ends = np.minimum(-(-division.ends // self.stride), len(self.poses))
        for i, (start, end) in enumerate(zip(division.starts // self.stride, ends, strict=True)):
            first = np.arange(1, end - start)
            if not len(first) or end - start >= self.costs.shape[1]:
                continue
            parts = self.costs[start, first] + self.costs[start + first, end - start - first].astype(np.float64)
            gain = self.costs[start, end - start] - parts + self.reward[start + first]
            best = int(np.argmax(gain))
            frames[i], gains[i] = (start + first[best]) * self.stride, max(float(gain[best]), 0.0)
        return frames, gains

    def _traced(
        self, lengths: list[Int[np.ndarray, "ends"]], gaps: list[Int[np.ndarray, "ends"]], last: int | None
    ) -> Division:
        """The clips, from the last to the first; in a chained pass (`last` is None) all are of that one pass."""
        bounds = []
        end, row = len(self.poses), last or 0
        while end > 0:
            end -= int(gaps[row][end])
            start = end - int(lengths[row][end])
            bounds.append((start, end))
            end, row = start, row if last is None else row - 1
        clips = np.array(bounds[::-1])
        starts, ends = clips[:, 0], clips[:, 1]
        following = np.minimum(ends, len(self.poses) - 1)
        openness = np.minimum(
            np.linalg.norm(self.poses[ends - 1] - self.poses[starts], axis=1),
            np.linalg.norm(self.poses[following] - self.poses[starts], axis=1),
        )
        to_frames = np.minimum(clips * self.stride, self.frames)
        to_frames[-1, 1] = self.frames if ends[-1] == len(self.poses) else to_frames[-1, 1]
        return Division(to_frames[:, 0], to_frames[:, 1], self._gains(starts, ends), openness / self.speed)

    def _gains(self, starts: Int[np.ndarray, "clips"], ends: Int[np.ndarray, "clips"]) -> Float[np.ndarray, "cuts"]:
        """How much dearer two neighbours would be as one clip; what no single clip can hold gains most."""
        lengths = np.minimum(ends - starts, self.costs.shape[1] - 1)
        own = self.costs[starts, lengths].astype(np.float64)
        joined = np.minimum(ends[1:] - starts[:-1], self.costs.shape[1] - 1)
        together = self.costs[starts[:-1], joined].astype(np.float64)
        return np.asarray(np.maximum(together - own[:-1] - own[1:] + self.reward[starts[1:]], 0.0))


_STILL = 1e-4
"""Of the highest speed: below that nothing moves."""


def _leading(values: Float[np.ndarray, "samples D"]) -> Float64[np.ndarray, "samples d"]:
    """Poses in the twelve directions in which they vary most."""
    centred = values - values.mean(axis=0, dtype=np.float64)
    _, directions = np.linalg.eigh(centred.T @ centred)
    return np.ascontiguousarray(centred @ directions[:, ::-1][:, :DIRECTIONS])


def _strays(poses: Float[np.ndarray, "samples d"]) -> float:
    """How far poses are from the cubic in time that is nearest to them, against how far from their mean; 0 to 1."""
    cubics, _ = np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1, 1, len(poses)), 3))
    centred = poses - poses.mean(axis=0)
    whole = float(np.square(centred).sum())
    return float(np.sqrt(np.square(centred - cubics @ (cubics.T @ centred)).sum() / whole)) if whole > 0 else 1.0


def _jumps(steps: Float[np.ndarray, "between"]) -> Float[np.ndarray, "samples"]:
    """For every sample: half the logarithm of how far the pose jumps to it, against the steps around."""
    around = np.pad(steps, 3, mode="edge")
    beside = np.stack([around[i : i + len(steps)] for i in (0, 1, 3, 4, 5)])
    usual = np.median(beside, axis=0) + _CALM
    return np.concatenate([[0.0], JUMP * np.log1p(np.maximum(steps / usual - 1, 0.0))])


_CALM = 0.3
"""Of the usual speed: a jump from rest is measured against that."""
