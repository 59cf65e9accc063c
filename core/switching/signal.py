"""The signal that is cut: windowed statistics of every descriptor, some ten times a second."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from threadpoolctl import threadpool_limits

from core.analysis import Features
from core.windows import window_statistics

WINDOW_SECONDS = 1.5
STEPS_PER_SECOND = 10.0
KEPT = 0.995
"""Share of the signal's energy whose directions are kept; the rest only costs time."""


@dataclass(frozen=True)
class Signal:
    """`values` (steps, D) at unit mean square, and `stride`: how many frames of the take a step stands for."""

    values: Float[np.ndarray, "steps D"]
    stride: int
    frames: int
    seconds_per_step: float

    def steps(self, seconds: float) -> int:
        """So many seconds in steps, at least one."""
        return max(round(seconds / self.seconds_per_step), 1)

    def per_frame(self, labels: Int[np.ndarray, "steps"]) -> Int[np.ndarray, "frames"]:
        """Labels of steps as labels of frames."""
        return np.asarray(np.repeat(labels, self.stride)[: self.frames])


def windowed_signal(features: tuple[Features, ...], frames: int, frame_rate: float) -> Signal | None:
    """Mean, deviation and RMS speed of every descriptor over a second and a half; None where nothing changes.

    The three statistics of a descriptor count alike, whatever their units, and so do the descriptors.
    """
    stride = max(round(frame_rate / STEPS_PER_SECOND), 1)
    at = np.minimum(np.arange(0, frames, stride) + stride // 2, frames - 1)
    half = max(round(WINDOW_SECONDS * frame_rate / 2), 1)
    parts = [
        part
        for feature in features
        for statistic in window_statistics(feature.values, half, frame_rate, at)
        if (part := at_unit_mean_square(statistic)) is not None
    ]
    if not parts:
        return None
    together = at_unit_mean_square(np.concatenate(parts, axis=1))
    return None if together is None else Signal(_leading(together), stride, frames, stride / frame_rate)


def at_unit_mean_square(values: Float[np.ndarray, "rows D"]) -> Float[np.ndarray, "rows D"] | None:
    """Centred, and scaled so that the mean squared length of a row is 1; None where all rows are the same."""
    centred = values - values.mean(axis=0, dtype=np.float64)
    square = float(np.einsum("rd,rd->", centred, centred)) / max(len(values), 1)
    return centred / np.sqrt(square) if square > 0 else None


def _leading(values: Float[np.ndarray, "steps D"]) -> Float[np.ndarray, "steps d"]:
    """The same rows in as few directions as hold `KEPT` of their energy: distances stay, D shrinks threefold."""
    with threadpool_limits(1):
        energy, directions = np.linalg.eigh(values.T @ values)
        share = np.cumsum(energy[::-1]) / energy.sum()
        kept = directions[:, ::-1][:, : int(np.searchsorted(share, KEPT)) + 1]
        largest = np.abs(kept).argmax(axis=0)
        return np.ascontiguousarray(values @ (kept * np.sign(kept[largest, np.arange(kept.shape[1])])))
