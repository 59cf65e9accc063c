"""Cuts where the body comes nearest to rest: minima of its speed (Fod, Matarić and Jenkins 2002, the paper's [6])."""

import numpy as np
from jaxtyping import Float, Int
from scipy.ndimage import minimum_filter1d, uniform_filter1d

from caesura.core.analysis import Analysis
from caesura.core.methods.segment_groups import cut_by_bounds
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 100_000
SMOOTH_SECONDS = 0.2
NEIGHBOURHOOD_SECONDS = 0.6
"""A minimum is the lowest within so many seconds, centred on it."""
SLOW = 0.5
"""A minimum counts below this share of the mean of the squared speed: theirs is a threshold set by hand."""


def velocity_minima(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where it all but stops, and put segments that are alike into K motions."""
    return cut_by_bounds(analysis, parameters, find_velocity_minima, MOST_FRAMES)


def find_velocity_minima(values: Float[np.ndarray, "frames D"], frame_rate: float) -> Int[np.ndarray, "bounds"]:
    """Where segments begin, and where the last one ends; linear in the frames.

    z is the sum over all measures of their squared change from frame to frame, averaged over 0.2 s. A frame is a bound
    where z is the least of the 0.6 s around it (of equal ones the first) and below half of its mean.
    """
    change = np.square(np.diff(values, axis=0)).sum(axis=1)
    around = max(round(SMOOTH_SECONDS * frame_rate), 1)
    speed = uniform_filter1d(change, around, mode="nearest") if len(change) else change
    half = max(round(NEIGHBOURHOOD_SECONDS * frame_rate / 2), 1)
    lowest = minimum_filter1d(speed, 2 * half + 1, mode="nearest") if len(speed) else speed
    chosen = [0]
    for frame in np.flatnonzero((speed <= lowest) & (speed < SLOW * speed.mean())) + 1 if len(speed) else ():
        if half <= frame <= len(values) - half and frame - chosen[-1] > half:
            chosen.append(int(frame))
    return np.array([*chosen, len(values)])
