"""Temporal reduction: frames that follow each other and look alike are represented by the first of them."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from sklearn.cluster import KMeans

SAMPLED_FRAMES = 20
STARTS = 50


@dataclass(frozen=True)
class TemporalReduction:
    """`bounds` (samples + 1): the first frame of every block, and the number of frames."""

    bounds: Int[np.ndarray, "bounds"]

    def of(self, values: Float[np.ndarray, "frames D"]) -> Float[np.ndarray, "samples D"]:
        """The first frame of every block."""
        return np.asarray(values[self.bounds[:-1]])

    def per_frame(self, labels: Int[np.ndarray, "samples"]) -> Int[np.ndarray, "frames"]:
        """Labels of samples as labels of frames."""
        return np.asarray(np.repeat(labels, np.diff(self.bounds)))


def reduce_frames(
    values: Float[np.ndarray, "frames D"], most: int, seed: int, looks: int = SAMPLED_FRAMES
) -> TemporalReduction:
    """Blocks of at most `most` frames of one look; k-means (50 starts) sorts the frames into `looks` looks."""
    frames = len(values)
    if most <= 1:
        return TemporalReduction(np.arange(frames + 1))
    looks = min(looks, len(np.unique(values, axis=0)))
    look = KMeans(looks, init="random", n_init=STARTS, max_iter=100, random_state=seed).fit_predict(values)
    firsts = [0]
    for frame in range(1, frames):
        if look[frame] != look[frame - 1] or frame - firsts[-1] == most:
            firsts.append(frame)
    return TemporalReduction(np.array([*firsts, frames]))
