"""Poses: all descriptors of a frame side by side."""

import numpy as np
from jaxtyping import Float

from caesura.core.analysis import Features


def pose_features(features: tuple[Features, ...]) -> Float[np.ndarray, "frames D"]:
    """Every descriptor at unit mean square about its mean, so that they count alike; none that never changes.

    No columns where nothing does.
    """
    parts = []
    for feature in features:
        centred = feature.values - feature.values.mean(axis=0, dtype=np.float64)
        square = float(np.einsum("fd,fd->", centred, centred)) / len(centred)
        if square > 0:
            parts.append(centred / np.sqrt(square))
    frames = len(features[0].values) if features else 0
    return np.concatenate(parts, axis=1) if parts else np.zeros((frames, 0))
