"""The frame kernel: how alike two frames are, 0 to 1."""

import numpy as np
from jaxtyping import Float

NEAREST = 0.02
"""Share of all frames that are near to one: their mean distance is what counts as near."""
ROUNDING = 1e-12
"""Squared distances below this share of the mean square are rounding: those frames are the same."""


def frame_kernel(values: Float[np.ndarray, "samples D"]) -> Float[np.ndarray, "samples samples"]:
    """exp(−d² / 2σ²) of the distances d of all pairs; σ is the mean distance to the nearest 2 %, itself among them.

    At least one other frame counts as near. O(samples²) time and memory.
    """
    values = values - values.mean(axis=0, dtype=np.float64)
    squares = np.einsum("sd,sd->s", values, values)
    square = values @ values.T
    square *= -2
    square += squares[:, None]
    square += squares
    square[square <= ROUNDING * squares.mean()] = 0.0
    near = min(max(int(NEAREST * len(values)), 2), len(values))
    width = float(np.sqrt(np.partition(square, near - 1, axis=1)[:, :near]).mean())
    square /= -(2 * width * width + np.finfo(np.float64).eps)
    np.exp(square, out=square)
    np.fill_diagonal(square, 1.0)
    return np.asarray(square)
