"""Segments into motions, where a method finds cuts alone: K-means on what is typical of each segment."""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float, Int
from sklearn.cluster import KMeans

from caesura.core.analysis import Analysis
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

STARTS = 20

FindBounds = Callable[[Float[np.ndarray, "frames D"], float], Int[np.ndarray, "bounds"]]
"""Poses and frames a second in; where segments begin, and where the last one ends, out."""


def cut_by_bounds(analysis: Analysis, parameters: Parameters, find: FindBounds, most_frames: int) -> Cut:
    """Cut a take by a compared method that finds bounds alone, and put segments that are alike into K motions."""

    def label_frames(
        values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
    ) -> Int[np.ndarray, "frames"]:
        return label_segments(values, find(values, frame_rate), motions, seed)

    return cut_by_compared_method(analysis, parameters, label_frames, most_frames)


def label_segments(
    values: Float[np.ndarray, "frames D"], bounds: Int[np.ndarray, "bounds"], motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    """A motion for every frame of the segments between `bounds`, the same for segments that are alike.

    A segment is the mean and the deviation of its frames; it counts by how long it is. Linear in the frames.
    """
    described, lengths = describe_segments(values, bounds), np.diff(bounds)
    groups = min(motions, len(np.unique(described, axis=0)))
    if groups == 1:
        return np.zeros(len(values), np.int64)
    fit = KMeans(groups, n_init=STARTS, random_state=seed).fit(described, sample_weight=lengths)
    return np.asarray(np.repeat(fit.labels_.astype(np.int64), lengths))


def describe_segments(
    values: Float[np.ndarray, "frames D"], bounds: Int[np.ndarray, "bounds"]
) -> Float[np.ndarray, "segments described"]:
    """Mean and deviation of every column in every segment, by running sums."""
    values = values - values.mean(axis=0, dtype=np.float64)
    lengths = np.diff(bounds)[:, None]
    mean = np.add.reduceat(values, bounds[:-1], axis=0) / lengths
    square = np.add.reduceat(np.square(values - np.repeat(mean, lengths[:, 0], axis=0)), bounds[:-1], axis=0)
    return np.concatenate([mean, np.sqrt(square / lengths)], axis=1)
