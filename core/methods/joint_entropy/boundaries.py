"""Where one motion ends and the next begins (paper, section 4.2)."""

import numpy as np
from jaxtyping import Float, Int


def find_boundary(energy: Float[np.ndarray, "frames"], left: int, right: int) -> int:
    """The frame m between key-frames left < m < right that minimises var(H[left..m]) + var(H[m..right]) (Eq. 5).

    Both ends belong to both sides; the first of equal frames. Neighbours (right = left + 1): `right`. By
    prefix sums, O(right − left).
    """
    return left + 1 + int(np.argmin(variance_curve(energy, left, right))) if right - left > 1 else right


def variance_curve(energy: Float[np.ndarray, "frames"], left: int, right: int) -> Float[np.ndarray, "between"]:
    """ξ^m = var(H[left..m]) + var(H[m..right]) at every frame between the two (Eq. 5); the unit of H squared."""
    between = energy[left : right + 1].astype(np.float64)
    return np.asarray((_prefix_variances(between) + _prefix_variances(between[::-1])[::-1])[1:-1])


def _prefix_variances(values: Float[np.ndarray, "n"]) -> Float[np.ndarray, "n"]:
    """The variance of the first 1, 2, … n values, about the mean of all so that few digits cancel."""
    centred = values - values.mean()
    count = np.arange(1, len(values) + 1)
    return np.cumsum(centred**2) / count - (np.cumsum(centred) / count) ** 2


def label_frames_between_keys(
    energy: Float[np.ndarray, "frames"], keys: Int[np.ndarray, "keys"], clusters: Int[np.ndarray, "keys"]
) -> Int[np.ndarray, "frames"]:
    """The cluster of every frame: key-frames' own, changing at the boundary between unlike neighbours."""
    labels = np.full(len(energy), clusters[0], np.int64)
    for here, there, motion, next_motion in zip(keys, keys[1:], clusters, clusters[1:], strict=False):
        if next_motion != motion:
            labels[find_boundary(energy, int(here), int(there)) :] = next_motion
    return labels
