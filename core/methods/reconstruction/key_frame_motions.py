"""From key-frames to motions: how many there are to be, their groups, and where one motion becomes the next."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.methods.joint_entropy.clustering import cluster_key_frames, count_distinct
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

FindKeys = Callable[[Float[np.ndarray, "frames D"], int, int], Int[np.ndarray, "keys"]]
"""Poses, how many key-frames, and a seed in; key-frames in order out, the first and the last frame among them."""


def cut_by_key_frames(analysis: Analysis, parameters: Parameters, find: FindKeys, most_frames: int) -> Cut:
    """Cut a take between key-frames of different motions, one key-frame for each half of ω, at least K + 1.

    Listed are those at which the energy curve has a value.
    """
    found: list[Int[np.ndarray, "keys"]] = []

    def divide(
        values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
    ) -> Int[np.ndarray, "frames"]:
        asked = round(2 * len(values) / frame_rate / parameters.keyframe_window_seconds)
        keys = find(values, min(max(asked, motions + 1, 2), len(values)), seed)
        found.append(keys)
        clusters = cluster_key_frames(values[keys], min(motions, count_distinct(values[keys])), seed)
        return label_by_nearest_key(keys, clusters.labels, len(values))

    cut = cut_by_compared_method(analysis, parameters, divide, most_frames)
    return replace(cut, key_frames=found[0][np.isfinite(analysis.energy[found[0]])]) if found else cut


def label_by_nearest_key(
    keys: Int[np.ndarray, "keys"], clusters: Int[np.ndarray, "keys"], frames: int
) -> Int[np.ndarray, "frames"]:
    """The cluster of the key-frame that counts most in the blend which a frame is; of two alike the earlier."""
    middles = (keys[:-1] + keys[1:]) // 2 + 1
    return np.asarray(np.repeat(clusters, np.diff([0, *middles.tolist(), frames])))
