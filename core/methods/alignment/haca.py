"""Hierarchical aligned cluster analysis (Zhou, De la Torre and Hodgins, TPAMI 2013)."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.hierarchy import cluster_in_two_levels
from caesura.core.methods.alignment.sample_rate import most_frames_per_sample, seconds_to_samples
from caesura.core.methods.alignment.segments import SegmentLengths
from caesura.core.methods.alignment.temporal_reduction import reduce_frames
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 5000
SHORTEST_SECONDS = 0.316
LONGEST_SECONDS = 0.396
"""Of a move, 8 and 10 of the authors' samples."""
ABOVE = SegmentLengths(4, 6)
"""Moves in a segment."""


def haca(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take into moves of a third of a second in 12 groups, and those, 4 to 6 at a time, into K motions."""
    return cut_by_compared_method(analysis, parameters, _label_frames, MOST_FRAMES)


def _label_frames(
    values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    reduced = reduce_frames(values, most_frames_per_sample(frame_rate), seed)
    kernel = frame_kernel(reduced.of(values))
    count, duration = len(kernel), len(values) / frame_rate
    moves = SegmentLengths(
        seconds_to_samples(SHORTEST_SECONDS, count, duration), seconds_to_samples(LONGEST_SECONDS, count, duration)
    )
    return reduced.per_frame(cluster_in_two_levels(kernel, motions, moves, ABOVE, seed).per_sample)
