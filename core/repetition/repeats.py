"""The repetitions of every segment."""

from itertools import pairwise

import numpy as np
from jaxtyping import Int
from threadpoolctl import threadpool_limits

from core.analysis import Features
from core.document import Interval
from core.repetition.beats import beats
from core.repetition.passage import passage
from core.repetition.period import period

FADE_SECONDS = 0.25
"""So near to a cut a motion is not yet, or no longer, itself: the period is found without it."""


def repeats(
    features: tuple[Features, ...], labels: Int[np.ndarray, "frames"], frame_rate: float
) -> tuple[tuple[Interval, ...], ...]:
    """For every segment the repetitions that tile it: the whole segment where nothing repeats."""
    cuts = np.flatnonzero(np.diff(labels)) + 1
    with threadpool_limits(1):
        return tuple(
            tuple(Interval(start=a, end=b) for a, b in pairwise(_bounds(features, start, end, frame_rate)))
            for start, end in pairwise([0, *cuts.tolist(), len(labels)])
        )


def _bounds(features: tuple[Features, ...], start: int, end: int, frame_rate: float) -> list[int]:
    fade = round(FADE_SECONDS * frame_rate)
    whole = passage(features, start, end, frame_rate)
    length = period(whole[fade : len(whole) - fade], frame_rate)
    return [start, end] if length == 0 else (start + beats(whole, length)).tolist()
