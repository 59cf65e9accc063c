"""The compiled loops of repetitions and loops."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}  # never nnan or ninf: they delete finiteness checks


@njit(nogil=True, cache=True)
def cheapest_repetition_ends(cost: Floats, lags: Ints, came_from: Ints) -> None:
    """came_from[e]: the end before e in the cheapest row of ends from 0 to e, −1 where no row of lags leads there.

    `cost[e, i]` is what ending at e costs, `lags[i]` after the end before. The first of equals.
    """
    ends = cost.shape[0]
    total = np.full(ends, np.inf)
    total[0] = 0.0
    for e in range(1, ends):
        for i in range(len(lags)):
            before = e - lags[i]
            if before >= 0 and total[before] + cost[e, i] < total[e]:
                total[e] = total[before] + cost[e, i]
                came_from[e] = before


@njit(nogil=True, cache=True, fastmath=FAST)
def cheapest_loop(
    poses: Floats, speeds: Floats, speed_weight: float, lags: Ints, stride: int
) -> tuple[float, int, int]:
    """The least |pose − pose a lag later|² + speed_weight · |speed − speed a lag later|², its frame and its lag.

    Every `stride`-th frame is looked at, lag by lag; the first of equals.
    """
    best, best_at, best_lag = np.inf, 0, lags[0]
    for lag in lags:
        for at in range(0, len(poses) - lag, stride):
            cost = _squared_distance(poses[at], poses[at + lag])
            if cost < best:
                cost += speed_weight * _squared_distance(speeds[at], speeds[at + lag])
                if cost < best:
                    best, best_at, best_lag = cost, at, lag
    return best, best_at, best_lag


@njit(nogil=True, cache=True, fastmath=FAST)
def mean_differences(seen: Floats, lags: Ints, around: int, found: Floats) -> None:
    """found[e, i]: the mean squared distance of the places up to `around` from e to those lags[i] before them.

    `found` has one row more than there are places, for the end of the last; it is judged by the place before it.
    """
    total = np.zeros(len(seen) + 1)
    for i in range(len(lags)):
        lag = lags[i]
        count = len(seen) - lag
        for at in range(count):
            total[at + 1] = total[at] + _squared_distance(seen[at], seen[at + lag])
        for at in range(count):
            first, last = max(at - around, 0), min(at + around + 1, count)
            found[lag + at, i] = (total[last] - total[first]) / (last - first)
        found[len(seen), i] = found[len(seen) - 1, i]


@njit(nogil=True, cache=True, fastmath=FAST)
def _squared_distance(one: Floats, other: Floats) -> float:
    square = 0.0
    for d in range(one.size):
        apart = one[d] - other[d]
        square += apart * apart
    return square
