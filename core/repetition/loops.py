"""Seamless loops: the whole repetitions of a segment after which pose and speed are most nearly what they were."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis, Features
from caesura.core.kernels import repetition
from caesura.core.segmentation_document import Interval, Loop
from caesura.core.single_threaded_blas import single_threaded_blas

MOST_CYCLES = 6
UNEVEN = 0.15
"""So much longer or shorter than whole repetitions of the median length a loop may be."""
SHORTEST_SHARE = 0.6
"""Of a segment that nothing repeats in: it is one repetition, and its loop has at least so much of it."""
SPEED_WEIGHT = 4.0
"""Of a difference in speed of one step a frame, against a difference in pose of one step: both squared."""
ENOUGH = 0.25
"""Of a squared step: fewer repetitions are taken where more of them match no better than so."""
COARSE_RATE = 30.0
"""Frames a second that are looked at first; of the best of them the neighbours are looked at too."""
MOST_FRAMES = 3000
"""About the middle of a segment: nobody needs a loop from farther apart."""
GOOD, FAIR = 2.0, 4.0
"""Steps between neighbouring frames that a seam may be: as at twice the speed, or at four times."""


@dataclass(frozen=True)
class LoopFinder:
    """The best loop of any segment of one take; a segment that two cuts of it have in common is searched once."""

    features: tuple[Features, ...]
    frame_rate: float
    _known: dict[tuple[int, int], Loop | None] = field(default_factory=dict)

    @classmethod
    def of(cls, analysis: Analysis) -> "LoopFinder":
        """Of an analysed take."""
        return cls(analysis.features, analysis.frame_rate)

    def within(self, start: int, end: int, repeats: Sequence[Interval]) -> Loop | None:
        """The best loop of frames [start, end), which `repeats` tile; None where neither they nor the ends repeat."""
        if (start, end) not in self._known:
            self._known[start, end] = _best_loop(self.features, self.frame_rate, start, end, repeats)
        return self._known[start, end]


def find_loops(
    loops: LoopFinder, labels: Int[np.ndarray, "frames"], repeats: Sequence[Sequence[Interval]]
) -> tuple[Loop | None, ...]:
    """For every segment its best loop."""
    cuts = np.flatnonzero(np.diff(labels)) + 1
    bounds = pairwise([0, *cuts.tolist(), len(labels)])
    with single_threaded_blas():
        return tuple(loops.within(a, b, inner) for (a, b), inner in zip(bounds, repeats, strict=True))


def search_loops(analysis: Analysis, parts: Sequence[tuple[int, int, Sequence[Interval]]]) -> tuple[Loop | None, ...]:
    """The best loop of frames [start, end) for each of `parts`, with the repetitions that tile it."""
    finder = LoopFinder.of(analysis)
    with single_threaded_blas():
        return tuple(finder.within(start, end, repeats) for start, end, repeats in parts)


def _best_loop(
    features: tuple[Features, ...], frame_rate: float, start: int, end: int, repeats: Sequence[Interval]
) -> Loop | None:
    spare = max(end - start - MOST_FRAMES, 0)
    first = start + spare // 2
    poses = _normalised_poses(features, first, end - (spare - spare // 2))
    stride = max(round(frame_rate / COARSE_RATE), 1)
    step = float(np.sqrt(_squares(np.diff(poses, axis=0)).mean())) if len(poses) > 2 else 0.0
    if step <= 0:
        return None
    speeds = np.gradient(poses, axis=0)
    search = _LoopSearch(poses / step, speeds / step, stride)
    period = float(np.median([part.end - part.start for part in repeats])) if len(repeats) > 1 else 0.0
    found = search.best(period)
    if found is None:
        return None
    at, lag, cycles = found
    seam = float(np.sqrt(_squares(poses[at + lag] - poses[at]))) / step
    if not period and seam > GOOD:
        return None
    match = "good" if seam <= GOOD else "fair" if seam <= FAIR else "poor"
    return Loop(start=first + at, end=first + at + lag, cycles=cycles, seam=round(seam, 3), match=match)


@dataclass(frozen=True)
class _LoopSearch:
    """`poses` and `speeds` (frames, d) in steps between neighbours; every `stride`-th frame is looked at first."""

    poses: Float[np.ndarray, "frames d"]
    speeds: Float[np.ndarray, "frames d"]
    stride: int

    def best(self, period: float) -> tuple[int, int, int] | None:
        """The first frame, the frames and the cycles of the best loop; `period` is 0 where nothing repeats."""
        by_cycles = [
            (cost, *self._refined(at, lag), cycles)
            for cycles, lags in self._lags(period)
            for cost, at, lag in [self._cheapest(lags)]
        ]
        if not by_cycles:
            return None
        least = min(cost for cost, *_ in by_cycles)
        _, at, lag, cycles = next(found for found in by_cycles if found[0] <= least + ENOUGH)
        return at, lag, cycles

    def _lags(self, period: float) -> Iterator[tuple[int, range]]:
        """The lengths, in frames, that each number of cycles may have."""
        longest = len(self.poses) - 1
        if not period:
            lags = range(max(int(longest * SHORTEST_SHARE), 2 * self.stride), longest + 1, self.stride)
            if lags:  # there are none in a few frames of very many a second
                yield 1, lags
            return
        for cycles in range(1, MOST_CYCLES + 1):
            shortest, most = int(cycles * period * (1 - UNEVEN)), int(cycles * period * (1 + UNEVEN))
            lags = range(max(shortest, 2), min(most, longest) + 1, self.stride)
            if lags:
                yield cycles, lags

    def _cheapest(self, lags: range) -> tuple[float, int, int]:
        """The cost, the first frame and the length of the best loop of these lengths."""
        return repetition.cheapest_loop(self.poses, self.speeds, SPEED_WEIGHT, np.array(lags, np.int64), self.stride)

    def _refined(self, at: int, lag: int) -> tuple[int, int]:
        """The best of the loops that begin and end less than a stride away."""
        reach = range(-self.stride + 1, self.stride)
        last = len(self.poses) - 1
        near = [(a, b) for i in reach for j in reach if 0 <= (a := at + i) < (b := at + lag + j) <= last]
        costs = [
            _squares(self.poses[b] - self.poses[a]) + SPEED_WEIGHT * _squares(self.speeds[b] - self.speeds[a])
            for a, b in near
        ]
        first, until = near[int(np.argmin(costs))]
        return first, until - first


def _normalised_poses(features: tuple[Features, ...], start: int, end: int) -> Float[np.ndarray, "frames d"]:
    """Every descriptor in frames [start, end) at unit mean square."""
    parts = [np.zeros((end - start, 0))]
    for feature in features:
        values = feature.values[start:end].astype(np.float64)
        values -= values.mean(axis=0)
        square = float(_squares(values).mean())
        if square > 0:
            parts.append(values / np.sqrt(square))
    return np.concatenate(parts, axis=1)


def _squares(values: Float[np.ndarray, "... d"]) -> Float[np.ndarray, "..."]:
    return np.asarray(np.einsum("...d,...d->...", values, values))
