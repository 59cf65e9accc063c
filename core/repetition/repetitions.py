"""The repetitions of every segment."""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from jaxtyping import Int

from caesura.core.analysis import Analysis, Features
from caesura.core.document import Interval
from caesura.core.repetition.period import find_period
from caesura.core.repetition.repetition_ends import find_repetition_ends
from caesura.core.repetition.segment_features import segment_features
from caesura.core.single_threaded_blas import single_threaded_blas

FADE_SECONDS = 0.25
"""So near to a cut a motion is not yet, or no longer, itself: the period is found without it."""


@dataclass(frozen=True)
class RepetitionFinder:
    """The repetitions of any segment of one take; a segment that two cuts of it have in common is counted once."""

    features: tuple[Features, ...]
    frame_rate: float
    _known: dict[tuple[int, int], tuple[Interval, ...]] = field(default_factory=dict)

    @classmethod
    def of(cls, analysis: Analysis) -> "RepetitionFinder":
        """Of an analysed take."""
        return cls(analysis.features, analysis.frame_rate)

    def within(self, start: int, end: int) -> tuple[Interval, ...]:
        """The repetitions that tile frames [start, end): the whole of them where nothing repeats."""
        if (start, end) not in self._known:
            bounds = _repetition_bounds(self.features, start, end, self.frame_rate)
            self._known[start, end] = tuple(Interval(start=a, end=b) for a, b in pairwise(bounds))
        return self._known[start, end]


def find_repetitions(
    repetitions: RepetitionFinder, labels: Int[np.ndarray, "frames"]
) -> tuple[tuple[Interval, ...], ...]:
    """For every segment the repetitions that tile it."""
    cuts = np.flatnonzero(np.diff(labels)) + 1
    with single_threaded_blas():
        return tuple(repetitions.within(*segment) for segment in pairwise([0, *cuts.tolist(), len(labels)]))


def _repetition_bounds(features: tuple[Features, ...], start: int, end: int, frame_rate: float) -> list[int]:
    fade = round(FADE_SECONDS * frame_rate)
    whole = segment_features(features, start, end, frame_rate)
    length = find_period(whole[fade : len(whole) - fade], frame_rate)
    return [start, end] if length == 0 else (start + find_repetition_ends(whole, length)).tolist()
