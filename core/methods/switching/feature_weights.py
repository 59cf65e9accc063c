"""A take under one weighting of its descriptors, and all its weightings: what cuts into any number of motions share."""

from dataclasses import dataclass, field
from functools import cached_property

from caesura.core.analysis import Analysis
from caesura.core.methods.switching.initial_segments import InitialSegments
from caesura.core.methods.switching.windowed_signal import DescriptorWindows, WindowedSignal

CHANGE_SECONDS = 1 / 3
"""What a change of motion costs: as much as a third of a second at the mean distance from the mean of all."""


@dataclass(frozen=True)
class WeightedTake:
    """The signal of one weighting, and its stretches, which do not depend on how many motions are asked for."""

    signal: WindowedSignal

    @property
    def penalty(self) -> float:
        """What a change costs, in steps at the mean distance from the mean of all."""
        return CHANGE_SECONDS / self.signal.seconds_per_step

    @cached_property
    def stretches(self) -> InitialSegments:
        """The stretches, however many there are."""
        return InitialSegments.of(self.signal, self.penalty)

    def at_least(self, motions: int) -> InitialSegments:
        """As many stretches as there are to be motions, where that is possible."""
        enough = motions <= len(self.stretches)
        return self.stretches if enough else InitialSegments.of(self.signal, self.penalty, at_least=motions)


@dataclass(frozen=True)
class Weightings:
    """The weightings of one take, each worked out when it is first asked for."""

    windows: DescriptorWindows
    _known: dict[tuple[float, ...], WeightedTake | None] = field(default_factory=dict)

    @classmethod
    def of(cls, analysis: Analysis) -> "Weightings":
        """Of the descriptors that tell anything."""
        features = tuple(feature for feature in analysis.features if feature.values.shape[1])
        return cls(DescriptorWindows.of(features, analysis.frames, analysis.frame_rate))

    @property
    def descriptors(self) -> int:
        """How many descriptors are weighed."""
        return len(self.windows.statistics)

    def by(self, weights: tuple[float, ...] = ()) -> WeightedTake | None:
        """The take with its descriptors weighed so, by default alike; None where nothing changes."""
        if weights not in self._known:
            signal = self.windows.signal(weights)
            self._known[weights] = None if signal is None else WeightedTake(signal)
        return self._known[weights]
