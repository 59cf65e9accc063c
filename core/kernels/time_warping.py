"""The compiled loop of subsequence dynamic time warping."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}  # never nnan or ninf: they delete finiteness checks

Floats32 = NDArray[np.float32]
Ints32 = NDArray[np.int32]


@njit(nogil=True, cache=True, fastmath=FAST)
def warp_onto_ranges(costs: Floats32, bend: float, total: Floats32, begins: Ints32) -> None:
    """total[s]: the least mean cost of the whole example bent onto a range that ends with step s, from begins[s] on.

    `costs` (steps, samples): how unlike each step is to each sample of the example. A path goes on by one step and one
    sample, by one step and two samples, or by two steps and one sample, so that no part is bent by more than two
    (Sakoe and Chiba 1978, symmetric, P = 1); every sample is paid once, a skipped step with its neighbour. Going
    on unevenly costs `bend`.
    """
    steps, samples = costs.shape
    infinite, price = np.float32(np.inf), np.float32(bend)
    before = np.full(samples, infinite, np.float32)
    last = np.full(samples, infinite, np.float32)
    now = np.empty(samples, np.float32)
    from_before = np.zeros(samples, np.int32)
    from_last = np.zeros(samples, np.int32)
    from_now = np.zeros(samples, np.int32)
    for s in range(steps):
        now[0], from_now[0] = costs[s, 0], s
        for k in range(1, samples):
            cost = costs[s, k]
            best, begin = last[k - 1] + cost, from_last[k - 1]
            if k > 1 and s > 0:
                other = last[k - 2] + costs[s, k - 1] + cost + price
                if other < best:
                    best, begin = other, from_last[k - 2]
            if s > 1:
                other = before[k - 1] + np.float32(0.5) * (costs[s - 1, k] + cost) + price
                if other < best:
                    best, begin = other, from_before[k - 1]
            now[k], from_now[k] = best, begin
        total[s], begins[s] = now[samples - 1] / samples, from_now[samples - 1]
        for k in range(samples):
            before[k], from_before[k] = last[k], from_last[k]
            last[k], from_last[k] = now[k], from_now[k]
