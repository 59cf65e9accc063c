"""The compiled loop that finds where repetitions end."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


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
