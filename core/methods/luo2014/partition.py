"""The segments of least dissimilarity within."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.kernels import dissimilarity


def partition_frames(values: Float[np.ndarray, "frames D"], segments: int, shortest: int) -> Int[np.ndarray, "bounds"]:
    """Where `segments` segments begin, and where the last ends; fewer, and shorter, where the frames do not suffice.

    The least Σ over segments of the average distance of all pairs of frames within one, exactly, by dynamic
    programming: O(frames² · segments) time.
    """
    frames = len(values)
    segments = min(segments, frames)
    shortest = min(shortest, frames // segments)
    least, head = np.empty((frames + 1, segments + 1)), np.zeros((frames + 1, segments + 1), np.int32)
    dissimilarity.best_partition(np.ascontiguousarray(values, np.float64), shortest, least, head)
    bounds = [frames]
    for n in range(segments, 0, -1):
        bounds.append(int(head[bounds[-1], n]))
    return np.array(bounds[::-1])
