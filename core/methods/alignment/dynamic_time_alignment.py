"""The dynamic time alignment kernel: how alike two segments are, whatever their speed."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.kernels import alignment


def dynamic_time_alignment_kernel(
    kernel: Float[np.ndarray, "samples samples"],
    weights: Float[np.ndarray, "samples"],
    bounds: Int[np.ndarray, "bounds"],
) -> Float[np.ndarray, "segments segments"]:
    """The kernel of all pairs of segments, 0 to 1 where that of the samples is (Shimodaira 2001, with weights).

    C(i, j) = max{C(i, j−1) + b_j k_ij, C(i−1, j) + a_i k_ij, C(i−1, j−1) + (a_i + b_j) k_ij} / (Σa + Σb) at the last
    corner, a and b the weights of the samples of either segment. O(samples²).
    """
    out = np.empty((len(bounds) - 1, len(bounds) - 1))
    alignment.align_segments(kernel, weights, bounds, out)
    return out
