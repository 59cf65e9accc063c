"""When the samples of a property are, and its value at any frame of the take.

Times are those of the property: what an archive says of all of them may be wrong.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from alembic3d import Abc
from jaxtyping import Float

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.takes.frame_rate import ASSUMED, count_frames, estimate_key_rate

WHOLE = 2e-3
"""Samples by which a frame may miss one and be it: times are rounded."""

Value = Float[np.ndarray, "..."]


@dataclass(frozen=True)
class SampledProperty:
    """A property: seconds of its samples, increasing, and what reads the one at a second. Of a constant, one sample."""

    seconds: Float[np.ndarray, "samples"]
    read: Callable[[float], Value]

    def at(self, second: float) -> Value:
        """Its value at a time: that of a sample, or between two samples straight from one to the other."""
        place = float(np.interp(second, self.seconds, np.arange(len(self.seconds))))
        nearest = round(place)
        if abs(place - nearest) < WHOLE:
            return self.read(float(self.seconds[nearest]))
        share = place - int(place)
        before, after = (self.read(float(self.seconds[int(place) + step])) for step in (0, 1))
        return before * (1 - share) + after * share


@dataclass(frozen=True)
class Clock:
    """The frames of a take: `begin` is the time of the first, in seconds of the file's clock."""

    begin: float
    rate: float
    frames: int

    def second(self, frame: int) -> float:
        """The time of a frame."""
        return self.begin + frame / self.rate


def nearest_sample(second: float) -> Any:
    """What the library calls a selector. Of an integer it makes a time, so that samples are chosen by theirs."""
    return Abc.ISampleSelector(second, Abc.ISampleSelector.TimeIndexType.kNearIndex)


def sampled(schema: Any, is_constant: bool, read: Callable[[float], Value], limits: Limits) -> SampledProperty:
    """A property or a schema of the library, with its times."""
    count = 1 if is_constant else max(schema.getNumSamples(), 1)
    limits.check("max_frames", count, "Export a part of the take")
    times = schema.getTimeSampling()
    seconds = np.array([times.getSampleTime(number) for number in range(count)], np.float64)
    if not np.isfinite(seconds).all() or (np.diff(seconds) < 0).any():
        raise InvalidModel("invalid-animation", "The times of the samples do not increase. Export the file again.")
    return SampledProperty(seconds, read)


def find_clock(properties: Iterable[SampledProperty], limits: Limits) -> Clock:
    """From the first sample of what changes to the last one, at the rate of what has most; raises `no-motion`."""
    moving = [found.seconds for found in properties if len(found.seconds) > 1 and found.seconds[-1] > found.seconds[0]]
    if not moving:
        raise InvalidModel("no-motion", "Nothing in the file moves: no mesh or transform has samples that differ.")
    densest = max(moving, key=len)
    begin, end = min(float(found[0]) for found in moving), max(float(found[-1]) for found in moving)
    mean = (len(densest) - 1) / float(densest[-1] - densest[0])
    rate = estimate_key_rate((densest - densest[0]).tolist()) or (mean if 0 < mean <= 1000 else ASSUMED)
    frames = count_frames(end - begin, rate)
    limits.check("max_seconds", end - begin, "Export a part of the take")
    limits.check("max_frames", frames, "Export a part of the take")
    return Clock(begin, rate, int(frames))
