"""The compiled loops over all pairs of frames."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}  # never nnan or ninf: they delete finiteness checks

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@njit(nogil=True, cache=True, fastmath=FAST)
def best_partition(values: Floats, shortest: int, least: Floats, head: NDArray[np.int32]) -> None:
    """least[e, n]: the least Σ of average distances within n segments of the first e frames; head[e, n]: where the last
    of them begins. The shorter last segment wins a tie.

    Distances are computed as they are needed, and only the sums up to one end are kept: O(frames · segments) memory.
    """
    frames, most = len(values), least.shape[1] - 1
    within = np.zeros(frames)
    least[:] = np.inf
    least[0, 0] = 0.0
    for last in range(frames):
        to_last = 0.0
        for first in range(last, -1, -1):
            to_last += _distance(values, first, last)
            within[first] += to_last
            length = last - first + 1
            if length < shortest:
                continue
            average = 2 * within[first] / (length * (length - 1)) if length > 1 else 0.0
            for n in range(1, most + 1):
                cost = least[first, n - 1] + average
                if cost < least[last + 1, n]:
                    least[last + 1, n], head[last + 1, n] = cost, first


@njit(nogil=True, cache=True, fastmath=FAST)
def mean_dissimilarity(values: Floats, bounds: Ints, out: Floats) -> None:
    """out[i, j]: the average distance of the frames of segment i to those of segment j, zero for i = j."""
    for i in range(len(out)):
        out[i, i] = 0.0
        for j in range(i):
            total = 0.0
            for a in range(bounds[i], bounds[i + 1]):
                for b in range(bounds[j], bounds[j + 1]):
                    total += _distance(values, a, b)
            total /= (bounds[i + 1] - bounds[i]) * (bounds[j + 1] - bounds[j])
            out[i, j] = out[j, i] = total


@njit(nogil=True, cache=True, fastmath=FAST, inline="always")
def _distance(values: Floats, one: int, other: int) -> float:
    square = 0.0
    for d in range(values.shape[1]):
        difference = values[one, d] - values[other, d]
        square += difference * difference
    return float(np.sqrt(square))
