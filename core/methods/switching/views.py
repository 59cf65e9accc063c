"""Views: ways to look at one take, which differ in how long a window is and in what counts how much.

No one window serves: a slow rhythm is longer than a short one, and a long one blurs what is brief. On one take the
strain of the surface tells the motions apart and the distances mislead, on another it is the other way round. So the
take is cut in every view, and what becomes of it is judged by something that is of no view (`neighbour_graph`).
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.switching.initial_segments import InitialSegments
from caesura.core.methods.switching.short_segments import remove_short_segments
from caesura.core.methods.switching.switching_k_means import SwitchingClusters, run_switching_k_means
from caesura.core.methods.switching.windowed_signal import DescriptorWindows, WindowedSignal

FRAMES_PER_SECOND = 30.0
CHANGE_SECONDS = 1 / 3
"""What a change of motion costs: as much as a third of a second at the mean distance from the mean of all."""
SHORT, LONG = 1.5, 2.75
"""Seconds of a window."""
PLAIN, EVEN = 0.0, 0.5
"""Power of their deviation by which components are divided: small parts of the body count for more in half of the
views."""


@dataclass(frozen=True)
class View:
    """Window in seconds, evenness of the components, and the weights of two descriptors."""

    seconds: float
    evenness: float
    weights: tuple[float, float]


BOTH, FIRST, SECOND = (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)
VIEWS = (
    View(SHORT, EVEN, BOTH),
    View(SHORT, PLAIN, BOTH),
    View(LONG, EVEN, BOTH),
    View(LONG, PLAIN, BOTH),
    View(SHORT, EVEN, FIRST),
    View(SHORT, EVEN, SECOND),
    View(SHORT, PLAIN, FIRST),
    View(SHORT, PLAIN, SECOND),
    View(LONG, EVEN, SECOND),
    View(LONG, PLAIN, SECOND),
)
"""The first leads: it tells about how many motions there are."""
MOST_NOISE = 0.25
STILL = 1e-5
MOST_FRAMES = 20_000
"""A longer take, of eleven minutes or more, is cut in the first two views only: more would double the time."""


@dataclass(frozen=True)
class Frames:
    """What is cut: the descriptors that change, at about 30 frames a second whatever the take's rate.

    Faster takes are averaged over `group` frames, so that noise and rate do not decide. `head`: so many groups at the
    beginning, and those at the end, in which nothing moves at all, are left to the motions beside them.
    """

    values: tuple[Float[np.ndarray, "frames _"], ...]
    frame_rate: float
    group: int
    count: int
    head: int = 0

    @classmethod
    def of(cls, analysis: Analysis) -> "Frames":
        """Of an analysed take."""
        group = max(round(analysis.frame_rate / FRAMES_PER_SECOND), 1)
        averaged = (_drop_noisy_components(_average_frames(feature.values, group)) for feature in analysis.features)
        values = tuple(value for value in averaged if value.shape[1])
        head, last = _moving_range(values)
        moving = tuple(value[head:last] for value in values)
        return cls(moving, analysis.frame_rate / group, group, analysis.frames, head)

    def per_frame(self, labels: Int[np.ndarray, "groups"]) -> Int[np.ndarray, "frames"]:
        """Labels of groups as labels of the take's own frames."""
        after = -(-self.count // self.group) - self.head - len(labels)
        return np.asarray(np.repeat(np.pad(labels, (self.head, after), "edge"), self.group)[: self.count])

    def frame(self, group: int) -> int:
        """The take's own frame at which a group begins, or the number of its frames."""
        return min((self.head + group) * self.group, self.count)


@dataclass(frozen=True)
class TakeInView:
    """A take in one view: the signal, and its stretches, which do not depend on how many motions are asked for."""

    signal: WindowedSignal

    @property
    def penalty(self) -> float:
        """What a change costs, in steps at the mean distance from the mean of all."""
        return CHANGE_SECONDS / self.signal.seconds_per_step

    @cached_property
    def stretches(self) -> InitialSegments:
        """The stretches, however many there are."""
        return InitialSegments.of(self.signal, self.penalty)

    def settled(self, motions: int) -> SwitchingClusters:
        """The steps in so many motions, or as many as can be told apart."""
        enough = motions <= len(self.stretches)
        stretches = self.stretches if enough else InitialSegments.of(self.signal, self.penalty, at_least=motions)
        return remove_short_segments(
            self.signal, run_switching_k_means(self.signal.values, stretches.grouped(motions), self.penalty)
        )


@dataclass(frozen=True)
class Views:
    """All views of a take, each worked out when it is first asked for; none where nothing changes."""

    frames: Frames
    _windows: dict[tuple[float, float], DescriptorWindows] = field(default_factory=dict)
    _viewed: dict[View, TakeInView] = field(default_factory=dict)

    @cached_property
    def names(self) -> tuple[View, ...]:
        """The views that show something; of a single descriptor only those that weigh two alike."""
        two = len(self.frames.values) == 2
        views = VIEWS if self.frames.count <= MOST_FRAMES * self.frames.group else VIEWS[:2]
        return tuple(view for view in views if (two or view.weights == BOTH) and self._has(view))

    def by(self, view: View) -> TakeInView:
        """The take in one view."""
        return self._viewed[view]

    def within(self, view: View, steps: Int[np.ndarray, "steps"]) -> TakeInView | None:
        """Some steps of the take, as if there were no others: what is small beside the rest is seen. None if all are
        alike."""
        signal = self._signal(view, steps)
        return None if signal is None else TakeInView(signal)

    def _signal(self, view: View, steps: Int[np.ndarray, "steps"] | slice = slice(None)) -> WindowedSignal | None:
        key = view.seconds, view.evenness
        if key not in self._windows:
            self._windows[key] = DescriptorWindows.of(self.frames.values, self.frames.frame_rate, *key)
        return self._windows[key].signal(view.weights if len(self.frames.values) == 2 else (), steps)

    def _has(self, view: View) -> bool:
        signal = self._signal(view) if self.frames.values else None
        if signal is not None:
            self._viewed[view] = TakeInView(signal)
        return signal is not None


def _moving_range(values: tuple[Float[np.ndarray, "frames _"], ...]) -> tuple[int, int]:
    """The frames [first, last) without those at the ends that repeat the first or the last pose; all if all do."""
    if not values:
        return 0, 0
    together = np.concatenate(values, axis=1)
    still = STILL * np.ptp(together, axis=0).max()
    moved = np.flatnonzero((np.abs(np.diff(together, axis=0)) > still).any(axis=1))
    return (int(moved[0]), int(moved[-1]) + 2) if len(moved) else (0, len(together))


def _drop_noisy_components(values: Float[np.ndarray, "frames D"]) -> Float[np.ndarray, "frames _"]:
    """The components of which at most a quarter of the variance is noise.

    Noise is what differs from the mean of the frames beside it: Σ (x₋ − 2 x + x₊)² is six times its square. The strain
    of a body of rigid parts is nothing but the noise of its vertices.
    """
    if len(values) < 3:
        return values
    second = np.diff(values, 2, axis=0).astype(np.float64)
    noise = np.einsum("fd,fd->d", second, second) / 6
    centred = values - values.mean(axis=0, dtype=np.float64)
    return np.asarray(values[:, noise <= MOST_NOISE * np.einsum("fd,fd->d", centred, centred)])


def _average_frames(values: Float[np.ndarray, "frames D"], group: int) -> Float[np.ndarray, "groups D"]:
    """Means of `group` frames each; the last group may be smaller."""
    if group == 1:
        return values
    starts = np.arange(0, len(values), group)
    sums = np.add.reduceat(values, starts, axis=0, dtype=np.float64)
    return np.asarray(sums / np.diff(np.append(starts, len(values)))[:, None], np.float32)
