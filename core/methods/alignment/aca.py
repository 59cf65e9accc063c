"""Aligned cluster analysis (Zhou, De la Torre and Hodgins, FG 2008)."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.alignment.cluster_analysis import cluster_by_alignment
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.initial_segmentation import InitialSegmenter
from caesura.core.methods.alignment.sample_rate import most_frames_per_sample, seconds_to_samples
from caesura.core.methods.alignment.segments import SegmentLengths
from caesura.core.methods.alignment.temporal_reduction import reduce_frames
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 5000
SHORTEST_SECONDS = 1.27
LONGEST_SECONDS = 2.37
"""Of what is a segment to the method, 32 and 60 of the authors' samples; neighbours of one motion are joined after."""


def aca(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take into segments of at most 2.37 s, in K groups that are alike when bent in time onto each other."""
    return cut_by_compared_method(analysis, parameters, _label_frames, MOST_FRAMES)


def _label_frames(
    values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    reduced = reduce_frames(values, most_frames_per_sample(frame_rate), seed)
    kernel = frame_kernel(reduced.of(values))
    count, duration = len(kernel), len(values) / frame_rate
    lengths = SegmentLengths(
        seconds_to_samples(SHORTEST_SECONDS, count, duration), seconds_to_samples(LONGEST_SECONDS, count, duration)
    )
    first = InitialSegmenter.of(kernel, np.ones(count), motions, lengths)
    found = cluster_by_alignment(kernel, first.weights, first.start(seed), first.lengths.longest)
    return reduced.per_frame(found.segments.per_sample)
