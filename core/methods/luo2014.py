"""Temporal segmentation of deforming meshes by least dissimilarity within segments (Luo et al., the paper's [16])."""

import numpy as np
from jaxtyping import Float, Int
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform

from caesura.core.analysis import Analysis
from caesura.core.kernels import dissimilarity
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 10_000
SECONDS_PER_SEGMENT = 2.5
SHORTEST_SECONDS = 1.0
"""A segment of one frame has no dissimilarity at all: without a shortest, nearly all would be single frames."""


def luo2014(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take into one segment for every 2.5 s, and those into K motions.

    The method knows neither motions that return nor how many segments there are. So there are as many as the take
    has times 2.5 s, at least K; the likest are one motion until K are left; and neighbours of one motion are joined.
    """
    return cut_by_compared_method(analysis, parameters, _label_frames, MOST_FRAMES)


def _label_frames(
    values: Float[np.ndarray, "frames D"],
    frame_rate: float,
    motions: int,
    seed: int,  # noqa: ARG001 -- no randomness
) -> Int[np.ndarray, "frames"]:
    shortest = max(round(SHORTEST_SECONDS * frame_rate), 1)
    segments = max(round(len(values) / frame_rate / SECONDS_PER_SEGMENT), motions)
    bounds = partition_frames(values, segments, shortest)
    return np.asarray(np.repeat(group_segments(values, bounds, motions), np.diff(bounds)))


def partition_frames(values: Float[np.ndarray, "frames D"], segments: int, shortest: int) -> Int[np.ndarray, "bounds"]:
    """Where `segments` segments begin, and where the last ends; fewer, and shorter, where the frames do not suffice.

    The least Σ over segments of the average distance of all pairs of frames within one, exactly, by dynamic
    programming: O(frames² · segments) time.
    """
    frames = len(values)
    segments = min(segments, frames)
    shortest = min(shortest, frames // segments)
    least, head = np.empty((frames + 1, segments + 1)), np.zeros((frames + 1, segments + 1), np.int32)
    dissimilarity.best_partition(np.ascontiguousarray(values, np.float64), shortest, least, head)
    bounds = [frames]
    for n in range(segments, 0, -1):
        bounds.append(int(head[bounds[-1], n]))
    return np.array(bounds[::-1])


def group_segments(
    values: Float[np.ndarray, "frames D"], bounds: Int[np.ndarray, "bounds"], motions: int
) -> Int[np.ndarray, "segments"]:
    """A motion for every segment: the nearest are joined until `motions` are left (average linkage, Sokal 1958).

    How far two segments are apart is the average distance of their frames. O(frames²).
    """
    segments = len(bounds) - 1
    if segments == 1:
        return np.zeros(1, np.int64)
    apart = np.empty((segments, segments))
    dissimilarity.mean_dissimilarity(np.ascontiguousarray(values, np.float64), bounds.astype(np.int64), apart)
    tree = linkage(squareform(apart, checks=False), "average")
    return np.asarray(fcluster(tree, motions, "maxclust") - 1, np.int64)
