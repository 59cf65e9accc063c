"""The ablation of the paper (sections 4 and 4.2): plain distances of frames in place of the energy curve."""

from collections.abc import Iterable

import numpy as np
from jaxtyping import Float, Float32


def compute_distance_curve(
    strains: Iterable[Float32[np.ndarray, "_ columns"]], frames: int
) -> Float[np.ndarray, "frames"]:
    """|f^m − f^{m+1}|, the Euclidean distance of a frame's normalised strains to the next frame's; no unit, from 0.

    `strains` come in blocks of frames. NaN at the last frame, which none follows. O(frames · columns).
    """
    curve = np.full(frames, np.nan)
    before: Float32[np.ndarray, "1 columns"] | None = None
    at = 0
    for block in strains:
        recent = block if before is None else np.concatenate([before, block])
        apart = np.diff(recent, axis=0)
        curve[at : at + len(apart)] = np.sqrt(np.einsum("fc,fc->f", apart, apart, dtype=np.float64))
        at, before = at + len(apart), block[-1:].copy()
    return curve
