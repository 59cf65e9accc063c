"""Recognition: which motion of a fitted take each segment of a new take is, by its nearest windows.

Shapes are in the docstrings alone, as in `estimators`.
"""

from collections.abc import Iterable
from typing import Self

import numpy as np
from sklearn.neighbors import KNeighborsClassifier

from caesura.core.methods.switching.window_statistics import compute_window_statistics
from caesura.core.segmentation_document import Segment

NEIGHBOURS = 5
WINDOWS_PER_LENGTH = 4
"""Windows overlap: so many begin within the length of one."""


class MotionRecogniser:
    """Knows the windows of a take of `values` (frames, D) and the motion of each.

    A window is `seconds` long, at most the segment, and described by mean, standard deviation and RMS speed of every
    column; each of the three counts alike. A segment is the motion that its windows' five nearest are, on average.
    """

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds

    def fit(self, values: np.ndarray, segments: Iterable[Segment], frame_rate: float) -> Self:
        """Learn the windows of every segment."""
        self._largest = float(np.abs(values).max(initial=0.0)) or 1.0  # so that no square is too large for a number
        described = [(self._describe(values, one, frame_rate), one.motion) for one in segments]
        windows = np.concatenate([found for found, _ in described])
        labels = np.concatenate([np.full(len(found), motion) for found, motion in described])
        thirds = np.split(windows, 3, axis=1)
        self._centre = windows.mean(axis=0)
        self._scale = np.concatenate([np.full(third.shape[1], scale_to_unit(third)) for third in thirds])
        self._classifier = KNeighborsClassifier(min(NEIGHBOURS, len(windows))) if windows.shape[1] else None
        if self._classifier is not None:
            self._classifier.fit((windows - self._centre) * self._scale, labels)
        return self

    def predict(self, values: np.ndarray, segments: Iterable[Segment], frame_rate: float) -> np.ndarray:
        """The motion of every frame (frames,) of another take in the same columns, all of a segment alike."""
        labels = np.zeros(len(values), np.int64)
        if self._classifier is None:
            return labels  # nothing moved in the fitted take, so it has one motion
        for segment in segments:
            windows = (self._describe(values, segment, frame_rate) - self._centre) * self._scale
            votes = self._classifier.predict_proba(windows).sum(axis=0)
            labels[segment.start : segment.end] = self._classifier.classes_[votes.argmax()]
        return labels

    def _describe(self, values: np.ndarray, segment: Segment, frame_rate: float) -> np.ndarray:
        """The windows of one segment, which do not reach into its neighbours: (windows, 3 D)."""
        within = np.asarray(values[segment.start : segment.end], np.float64) / self._largest
        half = max(round(self.seconds * frame_rate / 2), 1)
        at = np.arange(0, len(within), max(2 * half // WINDOWS_PER_LENGTH, 1))
        mean, deviation, speed = compute_window_statistics(within, half, frame_rate, at)
        return np.concatenate([mean + within.mean(axis=0, dtype=np.float64), deviation, speed], axis=1)


def scale_to_unit(values: np.ndarray) -> float:
    """What brings all columns of (rows, D) together to unit mean square about their mean; 1 where rows are alike."""
    centred = values - values.mean(axis=0)
    square = float(np.einsum("rd,rd->", centred, centred)) / max(len(values), 1)
    return float(1 / np.sqrt(square)) if square > 0 else 1.0
