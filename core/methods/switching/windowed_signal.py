"""The signal that is cut: windowed statistics of every descriptor, some ten times a second."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.methods.switching.window_statistics import compute_window_statistics

STEPS_PER_SECOND = 10.0
KEPT = 0.995
"""Share of the signal's energy whose directions are kept; the rest only costs time."""
NOISE = 1e-3


@dataclass(frozen=True)
class WindowedSignal:
    """`values` (steps, D) at unit mean square, and `stride`: how many frames of the take a step stands for.

    `window_seconds`: over how long each step looks.
    """

    values: Float[np.ndarray, "steps D"]
    stride: int
    frames: int
    seconds_per_step: float
    window_seconds: float = 1.5

    @property
    def window(self) -> int:
        """The window in steps."""
        return self.steps(self.window_seconds)

    def steps(self, seconds: float) -> int:
        """So many seconds in steps, at least one."""
        return max(round(seconds / self.seconds_per_step), 1)

    def per_frame(self, labels: Int[np.ndarray, "steps"]) -> Int[np.ndarray, "frames"]:
        """Labels of steps as labels of frames."""
        return np.asarray(np.repeat(labels, self.stride)[: self.frames])


@dataclass(frozen=True)
class DescriptorWindows:
    """Mean, deviation and RMS speed of every descriptor over a window, at every step.

    `statistics[descriptor][statistic]` (steps, components): computed once, however the descriptors are weighed.
    """

    statistics: tuple[tuple[Float[np.ndarray, "steps _"], ...], ...]
    frames: int
    frame_rate: float
    stride: int
    seconds: float

    @classmethod
    def of(
        cls,
        features: tuple[Float[np.ndarray, "frames _"], ...],
        frame_rate: float,
        seconds: float,
        evenness: float = 0.0,
    ) -> "DescriptorWindows":
        """The windows of a take, O(frames).

        Every component is divided by the power `evenness` of its deviation: 0 leaves them as they are, at 1 all would
        count alike. So small parts of the body count for more.
        """
        frames = len(features[0])
        stride = max(round(frame_rate / STEPS_PER_SECOND), 1)
        at = np.minimum(np.arange(0, frames, stride) + stride // 2, frames - 1)
        half = max(round(seconds * frame_rate / 2), 1)
        statistics = tuple(
            compute_window_statistics(_evened(values, evenness), half, frame_rate, at) for values in features
        )
        return cls(statistics, frames, frame_rate, stride, seconds)

    def signal(
        self, weights: tuple[float, ...] = (), steps: Int[np.ndarray, "steps"] | slice = slice(None)
    ) -> WindowedSignal | None:
        """The signal to cut, of all steps or of some; None where nothing changes.

        The three statistics of a descriptor count alike, whatever their units, and so do the descriptors but for
        their `weights`.
        """
        values = []
        for statistics, weight in zip(self.statistics, weights or (1.0,) * len(self.statistics), strict=True):
            for statistic in statistics:
                centred = statistic[steps] - statistic[steps].mean(axis=0)
                spread = _root_mean_square(centred)
                if spread * weight > 0:
                    values.append(centred * (weight / spread))
        if not values:
            return None
        together = np.concatenate(values, axis=1)
        directions = _leading_components(together) / _root_mean_square(together)
        seconds_per_step = self.stride / self.frame_rate
        return WindowedSignal(together @ directions, self.stride, self.frames, seconds_per_step, self.seconds)


def _evened(values: Float[np.ndarray, "frames D"], evenness: float) -> Float[np.ndarray, "frames D"]:
    """Components below a thousandth of the largest deviation are left out: they are noise."""
    deviation = values.std(axis=0, dtype=np.float64)
    if evenness == 0 or not deviation.any():
        return values
    share = deviation / deviation.max()
    return np.asarray(values * np.where(share > NOISE, np.maximum(share, NOISE) ** -evenness, 0.0))


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
