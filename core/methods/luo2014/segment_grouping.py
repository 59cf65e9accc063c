"""Segments into motions."""

import numpy as np
from jaxtyping import Float, Int
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform

from caesura.core.kernels import dissimilarity


def group_segments(
    values: Float[np.ndarray, "frames D"], bounds: Int[np.ndarray, "bounds"], motions: int
) -> Int[np.ndarray, "segments"]:
    """A motion for every segment: the nearest are joined until `motions` are left (average linkage, Sokal 1958).

    How far two segments are apart is the average distance of their frames. O(frames²).
    """
    segments = len(bounds) - 1
    if segments == 1:
        return np.zeros(1, np.int64)
    apart = np.empty((segments, segments))
    dissimilarity.mean_dissimilarity(np.ascontiguousarray(values, np.float64), bounds.astype(np.int64), apart)
    tree = linkage(squareform(apart, checks=False), "average")
    return np.asarray(fcluster(tree, motions, "maxclust") - 1, np.int64)
