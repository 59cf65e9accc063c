"""Temporal segmentation of deforming meshes by least dissimilarity within segments (Luo et al., the paper's [16])."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.comparison import cut_by_compared_method
from caesura.core.methods.luo2014.partition import partition_frames
from caesura.core.methods.luo2014.segment_grouping import group_segments
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
