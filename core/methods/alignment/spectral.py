"""Spectral clustering of single frames (Ng, Jordan and Weiss 2002), then no run too short, as ACA's authors have it."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.alignment.sample_rate import most_frames_per_sample, seconds_to_samples
from caesura.core.methods.alignment.short_runs import remove_short_runs
from caesura.core.methods.alignment.spectral_clustering import cluster_spectrally
from caesura.core.methods.alignment.temporal_reduction import reduce_frames
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 5000
SHORTEST_SECONDS = 1.27


def spectral(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its frames, grouped one by one into K, change group for at least 1.27 s."""
    return cut_by_compared_method(analysis, parameters, _label_frames, MOST_FRAMES)


def _label_frames(
    values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    reduced = reduce_frames(values, most_frames_per_sample(frame_rate), seed)
    kernel = frame_kernel(reduced.of(values))
    shortest = seconds_to_samples(SHORTEST_SECONDS, len(kernel), len(values) / frame_rate)
    return reduced.per_frame(remove_short_runs(cluster_spectrally(kernel, motions, seed), shortest))
