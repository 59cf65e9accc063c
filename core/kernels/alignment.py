"""The compiled loops of aligned cluster analysis: all of them quadratic in the number of samples."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}  # never nnan or ninf: they delete finiteness checks

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@njit(nogil=True, cache=True, fastmath=FAST)
def align_segments(kernel: Floats, weights: Floats, bounds: Ints, out: Floats) -> None:
    """out[i, j]: the dynamic time alignment kernel of segments i and j, bounds[i] … bounds[i+1] each.

    The dearest path through the kernel from corner to corner, where a step pays the weights of the samples it
    takes, over the weight of both segments.
    """
    segments = len(bounds) - 1
    row = np.empty(len(kernel))
    for i in range(segments):
        for j in range(i, segments):
            first, last = bounds[j], bounds[j + 1]
            own, other = 0.0, 0.0
            for x in range(first, last):
                other += weights[x]
            for y in range(bounds[i], bounds[i + 1]):
                a = weights[y]
                own += a
                before = 0.0  # the cell up and to the left
                for x in range(first, last):
                    b, k = weights[x], kernel[y, x]
                    if y == bounds[i]:
                        value = (a + b) * k if x == first else row[x - 1] + b * k
                    else:
                        value = row[x] + a * k
                        if x > first:
                            value = max(value, row[x - 1] + b * k, before + (a + b) * k)
                    before = row[x]
                    row[x] = value
            out[i, j] = out[j, i] = row[last - 1] / (own + other)


@njit(nogil=True, cache=True, fastmath=FAST)
def cut_anew(
    kernel: Floats, weights: Floats, bounds: Ints, labels: Ints, spread: Floats, longest: int, head: Ints, group: Ints
) -> float:
    """The best segmentation against given groups of segments: where the last segment of the first v+1 samples begins
    (`head`), which group it joins (`group`), and the cost of the whole.

    A segment costs its squared distance, in the kernel's space, to the mean of its group. `spread` is the mean
    likeness within each group. Segments are at most `longest`; the shortest wins a tie, then the first group.

    before[x, L] is the alignment table's cell of the L samples that end with the previous one, against the
    segment of x up to x: all lengths L go along together, side by side in memory.
    """
    samples, groups = len(kernel), len(spread)
    before = np.zeros((samples, longest + 1))
    now = np.zeros((samples, longest + 1))
    joined = np.empty((groups, longest + 1))
    weight = np.zeros(longest + 1)
    own = np.zeros(longest + 1)
    least = np.empty(samples)
    size = np.zeros(groups)
    for i in range(len(labels)):
        size[labels[i]] += 1
    for v in range(samples):
        reach = min(longest, v + 1)
        a = weights[v]
        for n in range(reach, 0, -1):
            weight[n] = weight[n - 1] + a
            own[n] = own[n - 1] + a * kernel[v, v]
        joined[:] = 0.0
        for i in range(len(labels)):
            other = 0.0
            for x in range(bounds[i], bounds[i + 1]):
                other += weights[x]
                _advance(before, now, x, x == bounds[i], a, weights[x], kernel[v, x], reach)
            last = bounds[i + 1] - 1
            for n in range(1, reach + 1):
                joined[labels[i], n] += now[last, n] / (weight[n] + other)
        _choose(v, own, weight, joined, size, spread, reach, least, head, group)
        before, now = now, before
    return float(least[samples - 1])


@njit(nogil=True, cache=True, fastmath=FAST)
def _choose(
    v: int, own: Floats, weight: Floats, joined: Floats, size: Floats, spread: Floats, reach: int, least: Floats,
    head: Ints, group: Ints,
) -> None:  # fmt: skip
    """The cheapest last segment of the first v+1 samples, and the group it joins."""
    least[v] = np.inf
    for n in range(1, reach + 1):
        so_far = least[v - n] if n <= v else 0.0
        for c in range(len(size)):
            if size[c] > 0:
                cost = so_far + own[n] / weight[n] - 2 * joined[c, n] / size[c] + spread[c]
                if cost < least[v]:
                    least[v], head[v], group[v] = cost, v - n + 1, c


@njit(nogil=True, cache=True, fastmath=FAST, inline="always")
def _advance(before: Floats, now: Floats, x: int, first: bool, a: float, b: float, k: float, reach: int) -> None:
    """One column of the alignment tables of all lengths: a new last sample of weight `a` against sample x."""
    both, up, left = (a + b) * k, a * k, b * k
    if first:
        now[x, 1] = both
        for n in range(2, reach + 1):
            now[x, n] = before[x, n - 1] + up
    else:
        now[x, 1] = now[x - 1, 1] + left
        for n in range(2, reach + 1):
            value = before[x, n - 1] + up
            other = before[x - 1, n - 1] + both
            value = other if other > value else value
            other = now[x - 1, n] + left
            now[x, n] = other if other > value else value


@njit(nogil=True, cache=True)
def persistent_likeness(kernel: Floats, longest: int, out: Floats) -> None:
    """out[i, j], i < j: the most that i and j are alike together with a pair on their diagonal, up to `longest` away.

    Two such pairs (i, j) and (i+w, j+w) raise all four of i, i+w against j, j+w to the lesser of the two.
    """
    samples = len(kernel)
    for i in range(samples):
        for j in range(i + 1, samples):
            for w in range(1, min(longest, samples - 1 - j) + 1):
                least = min(kernel[i, j], kernel[i + w, j + w])
                out[i, j] = max(out[i, j], least)
                out[i + w, j + w] = max(out[i + w, j + w], least)
                out[i, j + w] = max(out[i, j + w], least)
                if i + w < j:
                    out[i + w, j] = max(out[i + w, j], least)
    for i in range(samples):
        out[i, i] = 1.0
        for j in range(i):
            out[i, j] = out[j, i]


@njit(nogil=True, cache=True)
def pure_segments(labels: Ints, groups: int, shortest: int, longest: int, as_measured: bool, head: Ints) -> None:
    """head[v]: where the last segment of the first v+1 samples begins, when segments hold as few strangers as can be.

    A stranger is a sample whose label is not its segment's most frequent. Where no segmentation of the first v+1
    samples exists, head[v] is −1. `as_measured` takes the first length whose cost is at most `shortest`, else the
    longest: what the authors' program does, and their figures with it.
    """
    samples = len(labels)
    least = np.full(samples, np.inf)
    head[:] = -1
    for v in range(samples):
        count = np.zeros(groups, np.int64)
        most = 0
        for n in range(1, min(longest, v + 1) + 1):
            label = labels[v - n + 1]
            count[label] += 1
            most = max(most, count[label])
            so_far = least[v - n] if n <= v else 0.0
            if n < shortest or np.isinf(so_far):
                continue
            cost = so_far + n - most
            if (least[v] > shortest) if as_measured else (cost < least[v]):
                least[v], head[v] = cost, v - n + 1
