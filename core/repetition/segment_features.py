"""A passage: the poses and speeds of one segment, as few numbers as tell its repetitions."""

import numpy as np
from jaxtyping import Float

from caesura.core.analysis import Features
from caesura.core.methods.switching.window_statistics import compute_speeds

DIRECTIONS = 12
"""Of poses and speeds together; the rest is noise and only costs time."""


def segment_features(
    features: tuple[Features, ...], start: int, end: int, frame_rate: float
) -> Float[np.ndarray, "frames d"]:
    """Every descriptor and its speed in frames [start, end), each at unit mean square there, in leading directions.

    Speeds count as much as poses: a wave of the hand is small and fast, and the sway of the body under it large and
    slow. No column where nothing moves.
    """
    parts = []
    for feature in features:
        values = feature.values[start:end].astype(np.float64)
        values -= values.mean(axis=0)
        for part in (values, compute_speeds(values, frame_rate)):
            square = float(np.einsum("fd,fd->", part, part)) / len(part)
            if square > _TINY:
                parts.append(part / np.sqrt(square))
    if not parts:
        return np.zeros((end - start, 0))
    together = np.concatenate(parts, axis=1)
    together -= together.mean(axis=0)
    _, directions = np.linalg.eigh(together.T @ together)
    return np.asarray(together @ directions[:, ::-1][:, :DIRECTIONS])


_TINY = 1e-12  # squared, of features that are measured in body sizes or strains: rounding, not motion
