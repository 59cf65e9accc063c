"""The signal that is cut: windowed statistics of every descriptor, some ten times a second."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Features
from caesura.core.methods.switching.window_statistics import compute_window_statistics

WINDOW_SECONDS = 1.5
STEPS_PER_SECOND = 10.0
KEPT = 0.995
"""Share of the signal's energy whose directions are kept; the rest only costs time."""


@dataclass(frozen=True)
class WindowedSignal:
    """`values` (steps, D) at unit mean square, and `stride`: how many frames of the take a step stands for.

    `size` and `tempo` (steps, D): where a step would go if its motion were performed twice as large, or twice as
    fast. Repetitions of one motion differ along these, and are one motion all the same.
    """

    values: Float[np.ndarray, "steps D"]
    size: Float[np.ndarray, "steps D"]
    tempo: Float[np.ndarray, "steps D"]
    stride: int
    frames: int
    seconds_per_step: float

    def steps(self, seconds: float) -> int:
        """So many seconds in steps, at least one."""
        return max(round(seconds / self.seconds_per_step), 1)

    def per_frame(self, labels: Int[np.ndarray, "steps"]) -> Int[np.ndarray, "frames"]:
        """Labels of steps as labels of frames."""
        return np.asarray(np.repeat(labels, self.stride)[: self.frames])


@dataclass(frozen=True)
class DescriptorWindows:
    """Mean, deviation and RMS speed of every descriptor over a second and a half, at every step.

    `statistics[descriptor][statistic]` (steps, components): computed once, however the descriptors are weighed.
    """

    statistics: tuple[tuple[Float[np.ndarray, "steps _"], ...], ...]
    frames: int
    frame_rate: float
    stride: int

    @classmethod
    def of(cls, features: tuple[Features, ...], frames: int, frame_rate: float) -> "DescriptorWindows":
        """The windows of a take, O(frames)."""
        stride = max(round(frame_rate / STEPS_PER_SECOND), 1)
        at = np.minimum(np.arange(0, frames, stride) + stride // 2, frames - 1)
        half = max(round(WINDOW_SECONDS * frame_rate / 2), 1)
        statistics = tuple(compute_window_statistics(feature.values, half, frame_rate, at) for feature in features)
        return cls(statistics, frames, frame_rate, stride)

    def signal(self, weights: tuple[float, ...] = ()) -> WindowedSignal | None:
        """The signal to cut; None where nothing changes.

        The three statistics of a descriptor count alike, whatever their units, and so do the descriptors but for
        their `weights`.
        """
        values, size, tempo = [], [], []
        for statistics, weight in zip(self.statistics, weights or (1.0,) * len(self.statistics), strict=True):
            for number, statistic in enumerate(statistics):
                centred = statistic - statistic.mean(axis=0)
                spread = _root_mean_square(centred)
                if spread * weight > 0:
                    unit = weight / spread
                    values.append(centred * unit)
                    size.append(statistic * (unit * (number > 0)))  # deviation and speed grow with the motion, …
                    tempo.append(statistic * (unit * (number > 1)))  # … and speed with its speed
        if not values:
            return None
        together = np.concatenate(values, axis=1)
        directions = _leading_components(together) / _root_mean_square(together)
        return WindowedSignal(
            together @ directions,
            np.concatenate(size, axis=1) @ directions,
            np.concatenate(tempo, axis=1) @ directions,
            self.stride,
            self.frames,
            self.stride / self.frame_rate,
        )


def _root_mean_square(values: Float[np.ndarray, "rows D"]) -> float:
    """The RMS length of a row."""
    return float(np.sqrt(np.einsum("rd,rd->", values, values) / len(values)))


def _leading_components(values: Float[np.ndarray, "steps D"]) -> Float[np.ndarray, "D d"]:
    """As few orthonormal directions as hold `KEPT` of the energy: distances stay, and D shrinks threefold."""
    energy, directions = np.linalg.eigh(values.T @ values)
    share = np.cumsum(energy[::-1]) / energy.sum()
    kept = directions[:, ::-1][:, : int(np.searchsorted(share, KEPT)) + 1]
    largest = np.abs(kept).argmax(axis=0)
    return np.asarray(kept * np.sign(kept[largest, np.arange(kept.shape[1])]))
