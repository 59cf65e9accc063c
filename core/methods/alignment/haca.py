"""Hierarchical aligned cluster analysis (Zhou, De la Torre and Hodgins, TPAMI 2013)."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.hierarchy import hierarchy
from caesura.core.methods.alignment.sample_rate import frames_per_sample, samples
from caesura.core.methods.alignment.segments import Lengths
from caesura.core.methods.alignment.temporal_reduction import reduction
from caesura.core.methods.comparison import compared
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 5000
SHORTEST_SECONDS = 0.316
LONGEST_SECONDS = 0.396
"""Of a move, 8 and 10 of the authors' samples."""
ABOVE = Lengths(4, 6)
"""Moves in a segment."""


def haca(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take into moves of a third of a second in 12 groups, and those, 4 to 6 at a time, into K motions."""
    return compared(analysis, parameters, _divide, MOST_FRAMES)


def _divide(
    values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    reduced = reduction(values, frames_per_sample(frame_rate), seed)
    kernel = frame_kernel(reduced.of(values))
    count, duration = len(kernel), len(values) / frame_rate
    moves = Lengths(samples(SHORTEST_SECONDS, count, duration), samples(LONGEST_SECONDS, count, duration))
    return reduced.per_frame(hierarchy(kernel, motions, moves, ABOVE, seed).per_sample)
