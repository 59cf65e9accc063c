"""The frame rate of a clip, estimated from the times of its keys. Light: no NumPy."""

from collections.abc import Sequence
from itertools import pairwise
from statistics import median

KNOWN = (23.976, 24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 59.94, 60.0, 100.0, 120.0, 240.0)
"""Frames per second that people work at."""

ASSUMED = 30.0
"""Where the keys do not tell."""

NEAR = 0.015
"""A measured rate may be off by this share: keys are float32, or were rounded to milliseconds."""

WHOLE = 0.05
"""Frames by which a key may miss its frame, for the same reasons."""

FLOAT32_STEP = 2.0**-23
"""The distance of neighbouring float32 numbers, as a share of the smaller; a key is off by half of it at most."""


def snap_frame_rate(rate: float) -> float | None:
    """The known rate that is nearest to `rate`, if it is within 1.5 % of it."""
    nearest = min(KNOWN, key=lambda known: abs(known - rate))
    return nearest if abs(nearest - rate) <= NEAR * nearest else None


def estimate_key_rate(times: Sequence[float]) -> float | None:
    """Frames per second of keys at `times` (seconds, not decreasing), or None where they do not tell.

    A key on every frame: one over the usual distance. Sparse keys: the lowest known rate that has all of them on
    whole frames, unless two of the basic rates have.
    """
    steps = [b - a for a, b in pairwise(times) if b > a]
    if not steps:
        return None
    span, usual = times[-1] - times[0], median(steps)
    # float32 times of a long session are too coarse for one step, but not for the mean of even ones.
    even = abs(span / usual - len(steps)) <= 0.02 * len(steps)
    return snap_frame_rate(len(steps) / span if even else 1 / usual) or _rate_of_sparse_keys(times)


def _rate_of_sparse_keys(times: Sequence[float]) -> float | None:
    missed = {rate: max(_distance_from_frames((time - times[0]) * rate) for time in times) for rate in KNOWN}
    # 23.976 and 24 differ by less than a frame in a short clip: the one that fits better stands for both.
    fits = [
        rate
        for rate in KNOWN
        if missed[rate] <= WHOLE and all(missed[rate] <= missed[other] for other in KNOWN if _rates_agree(rate, other))
    ]
    # Keys at every half second are on frames of 24, 25 and 30 alike: that tells nothing.
    basic = [rate for rate in fits if rate <= ASSUMED]
    return fits[0] if fits and len(basic) <= 1 else None


def _distance_from_frames(frames: float) -> float:
    return abs(frames - round(frames))


def _rates_agree(rate: float, other: float) -> bool:
    return abs(rate - other) <= 0.002 * rate


def count_frames(duration: float, rate: float) -> float:
    """Frames of a clip of `duration` seconds, its first at 0: floor(duration · rate + ε) + 1.

    Keys are float32, so 3.33333325 s · 30 = 99.9999976 must still be 101 frames: ε is 1e-4 of a frame, and in long
    takes the step of float32 at their end, 2^-23 of them. A float that may be infinite: compare it with a limit before
    making an integer of it.
    """
    frames = duration * rate
    return (frames + max(1e-4, frames * FLOAT32_STEP)) // 1 + 1
