"""Aligned cluster analysis (Zhou, De la Torre and Hodgins, FG 2008)."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.alignment.cluster_analysis import aligned
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.initial_segmentation import Initial
from caesura.core.methods.alignment.sample_rate import frames_per_sample, samples
from caesura.core.methods.alignment.segments import Lengths
from caesura.core.methods.alignment.temporal_reduction import reduction
from caesura.core.methods.comparison import compared
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 5000
SHORTEST_SECONDS = 1.27
LONGEST_SECONDS = 2.37
"""Of what is a segment to the method, 32 and 60 of the authors' samples; neighbours of one motion are joined after."""


def aca(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take into segments of at most 2.37 s, in K groups that are alike when bent in time onto each other."""
    return compared(analysis, parameters, _divide, MOST_FRAMES)


def _divide(
    values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    reduced = reduction(values, frames_per_sample(frame_rate), seed)
    kernel = frame_kernel(reduced.of(values))
    count, duration = len(kernel), len(values) / frame_rate
    lengths = Lengths(samples(SHORTEST_SECONDS, count, duration), samples(LONGEST_SECONDS, count, duration))
    first = Initial.of(kernel, np.ones(count), motions, lengths)
    found = aligned(kernel, first.weights, first.start(seed), first.lengths.longest)
    return reduced.per_frame(found.segments.per_sample)
