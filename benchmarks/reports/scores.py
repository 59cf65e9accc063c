"""One labelling against its truth, and the rows and means of such scores."""

from dataclasses import astuple, dataclass

import numpy as np
from jaxtyping import Int

from benchmarks.takes.sequences import Known
from caesura.core.agreement import (
    adjusted_rand_index,
    boundary_scores,
    cut_frames,
    frame_accuracy,
    rand_index,
    segment_f1,
)


@dataclass(frozen=True)
class Scores:
    """All 0 to 1 but for the number of motions, the hits and the seconds it took."""

    accuracy: float
    rand: float
    adjusted_rand: float
    segments: tuple[float, float, float]  # F1 at an overlap of 10, 25 and 50 %
    boundary: tuple[float, float]  # F1 within 0.5 and 0.15 s
    motions: float
    exact: float
    hits: float  # true cuts with a found cut in their accepted range
    seconds: float

    @classmethod
    def of(cls, labels: Int[np.ndarray, "frames"], known: Known, seconds: float) -> "Scores":
        """Every figure of one labelling."""
        truth, rate, cuts = known.truth, known.analysis.frame_rate, cut_frames(labels)
        wide, narrow = (boundary_scores(cuts, cut_frames(truth), round(t * rate)).f1 for t in (0.5, 0.15))
        tenth, quarter, half = (segment_f1(labels, truth, overlap).f1 for overlap in (0.1, 0.25, 0.5))
        found = len(np.unique(labels))
        return cls(
            frame_accuracy(labels, truth),
            rand_index(labels, truth),
            adjusted_rand_index(labels, truth),
            (tenth, quarter, half),
            (wide, narrow),
            found,
            found == known.motions,
            sum(bool(((first <= cuts) & (cuts <= last)).any()) for first, last in known.ranges),
            seconds,
        )

    @property
    def flat(self) -> list[float]:
        """The figures in a row: the places of `ACCURACY` and the rest."""
        return [float(value) for value in np.hstack(astuple(self))]


ACCURACY, RAND, ADJUSTED, TENTH, QUARTER, HALF, WIDE, NARROW, MOTIONS, EXACT, HITS, SECONDS = range(12)
"""Where the figures stand in `Scores.flat`."""


@dataclass(frozen=True)
class Row:
    """One take, one method, told K or more or nothing: the scores of all seeds, and the first seed's labels."""

    known: Known
    method: str
    told: str
    features: str
    scores: tuple[Scores, ...]
    labels: Int[np.ndarray, "frames"]

    @property
    def means(self) -> np.ndarray:
        """Every figure's mean over the seeds."""
        return np.asarray(np.mean([scores.flat for scores in self.scores], axis=0))


def of(rows: list[Row], method: str, told: str, *groups: str) -> list[Row]:
    """The rows of a method on takes of some groups."""
    return [row for row in rows if (row.method, row.told) == (method, told) and row.known.group in groups]


def mean(rows: list[Row], figure: int) -> float:
    """The mean over takes of one figure; NaN where there are none."""
    return float(np.mean([row.means[figure] for row in rows])) if rows else float("nan")
