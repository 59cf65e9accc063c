"""Spectral clustering of single frames (Ng, Jordan and Weiss 2002), then no run too short, as ACA's authors have it."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.sample_rate import frames_per_sample, samples
from caesura.core.methods.alignment.short_runs import without_short_runs
from caesura.core.methods.alignment.spectral_clustering import spectral_groups
from caesura.core.methods.alignment.temporal_reduction import reduction
from caesura.core.methods.comparison import compared
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 5000
SHORTEST_SECONDS = 1.27


def spectral(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its frames, grouped one by one into K, change group for at least 1.27 s."""
    return compared(analysis, parameters, _divide, MOST_FRAMES)


def _divide(
    values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    reduced = reduction(values, frames_per_sample(frame_rate), seed)
    kernel = frame_kernel(reduced.of(values))
    shortest = samples(SHORTEST_SECONDS, len(kernel), len(values) / frame_rate)
    return reduced.per_frame(without_short_runs(spectral_groups(kernel, motions, seed), shortest))
