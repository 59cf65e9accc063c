"""The frames of a stage: the range that it states, or that of its samples, at the rate of its samples."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from caesura.core.limits import Limits
from caesura.formats.notices import Notices
from caesura.formats.takes.frame_rate import ASSUMED, count_frames, estimate_key_rate

FASTEST = 1e6
"""Time codes a second; some stages count in ticks."""


@dataclass(frozen=True)
class Clock:
    """`frames` of a take, the first at time code `begin`."""

    begin: float
    codes_per_second: float
    rate: float
    frames: int

    def code(self, frame: int) -> float:
        """The time code of a frame."""
        return self.begin + frame * self.codes_per_second / self.rate


def find_clock(stage: Any, sampled: Iterable[Any], limits: Limits, notices: Notices) -> Clock:
    """The clock of a stage with the times of what is `sampled`, a list for each attribute.

    Raises `LimitExceeded` before anything is evaluated.
    """
    codes = float(stage.GetTimeCodesPerSecond())
    codes = codes if 0 < codes <= FASTEST else 24.0
    lists = [found for found in sampled if len(found) > 1]
    densest = np.array(max(lists, key=len, default=[0.0]), np.float64)
    begin, end = float(stage.GetStartTimeCode()), float(stage.GetEndTimeCode())
    if not (stage.HasAuthoredTimeCodeRange() and 0 < end - begin < limits.max_seconds * codes):
        begin = min((found[0] for found in lists), default=0.0)
        end = max((found[-1] for found in lists), default=0.0)
    mean = codes * (len(densest) - 1) / max(float(densest[-1] - densest[0]), 1e-9)
    rate = estimate_key_rate(((densest - densest[0]) / codes).tolist()) or (codes if codes <= 1000 else mean)
    rate = rate if 0 < rate <= 1000 else ASSUMED
    seconds = (end - begin) / codes
    limits.check("max_seconds", seconds, "Export a part of the take")
    frames = count_frames(seconds, rate)
    limits.check("max_frames", frames, "Export a part of the take")
    if abs(begin / codes * rate) >= 0.5:
        notices.add("take-start", f"The take begins at time code {begin:g}; frames are counted from there.")
    return Clock(begin, codes, rate, int(frames))
