"""The compiled loops of switching k-means: all of them linear in the number of steps."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}  # never nnan or ninf: they delete finiteness checks

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Ints = NDArray[np.int64]


@njit(nogil=True, cache=True)
def viterbi(cost: Floats, penalty: float, labels: Ints) -> float:
    """The labels of least Σ cost[t, label] + penalty · changes, and that sum. Staying wins a tie, then the first."""
    steps, states = cost.shape
    came_from = np.empty((steps, states), np.int32)
    total = cost[0].copy()
    for t in range(1, steps):
        best = np.argmin(total)
        switched = total[best] + penalty
        for k in range(states):
            came_from[t, k] = k
            if switched < total[k]:
                came_from[t, k] = best
                total[k] = switched
            total[k] += cost[t, k]
    state = np.argmin(total)
    least = total[state]
    for t in range(steps - 1, -1, -1):
        labels[t] = state
        if t > 0:
            state = came_from[t, state]
    return float(least)


@njit(nogil=True, cache=True)
def squares_from_products(products: Floats, squares: Floats, mean_squares: Floats) -> None:
    """Products −2 a · m of rows and means become squared distances: + a · a + m · m, and none below 0."""
    for row in range(products.shape[0]):
        for k in range(products.shape[1]):
            products[row, k] = max(products[row, k] + squares[row] + mean_squares[k], 0.0)


@njit(nogil=True, cache=True)
def add_by_label(values: Floats, labels: Ints, sums: Floats) -> None:
    """sums[label] += row, of every row and its label, one after another."""
    for row in range(values.shape[0]):
        of_label = sums[labels[row]]
        for d in range(values.shape[1]):
            of_label[d] += values[row, d]


@njit(nogil=True, cache=True, fastmath=FAST)
def distances_to_nearest(poses: Singles, examples: Singles, count: int, distances: Floats) -> None:
    """The mean distance of every pose (poses, D) to the `count` nearest of as many examples or more (D, examples).

    One direction after another, so that the loops over examples become vector instructions.
    """
    size = examples.shape[1]
    square, least = np.empty(size, np.float32), np.empty(count, np.float32)
    for i in range(poses.shape[0]):
        square[:] = np.float32(0)
        for d in range(poses.shape[1]):
            of_pose, of_examples = poses[i, d], examples[d]
            for e in range(size):
                apart = of_examples[e] - of_pose
                square[e] += apart * apart
        least[:] = np.float32(np.inf)
        for e in range(size):
            if square[e] < least[count - 1]:
                at = count - 1
                while at > 0 and square[e] < least[at - 1]:
                    least[at] = least[at - 1]
                    at -= 1
                least[at] = square[e]
        total = 0.0
        for n in range(count):
            total += np.sqrt(least[n])
        distances[i] = total / count


@njit(nogil=True, cache=True)
def add_links(
    weights: Floats, columns: NDArray[np.int32], ends: NDArray[np.int32], labels: Ints, links: Floats
) -> None:
    """links[a, b] += the weights of all links from label a to label b, of a sparse matrix by rows."""
    for row in range(len(labels)):
        of_label = links[labels[row]]
        for i in range(ends[row], ends[row + 1]):
            of_label[labels[columns[i]]] += weights[i]


@njit(nogil=True, cache=True, fastmath=FAST)
def least_cost_partition(signal: Floats, squares: Floats, penalty: float, longest: int, start_of: Ints) -> None:
    """start_of[e]: where the last piece begins in the best partition of the first e steps.

    Least Σ squared distance of each piece to its mean + penalty · pieces, pieces of at most `longest` steps; exact,
    by dynamic programming with the pruning of PELT (Killick 2012). `signal` and `squares` are running sums.
    """
    steps, size = signal.shape[0] - 1, signal.shape[1]
    least = np.empty(steps + 1)
    value = np.empty(longest + 1)
    starts = np.empty(longest + 1, np.int64)
    least[0] = -penalty
    starts[0] = 0
    kept = 1
    for e in range(1, steps + 1):
        best = np.inf
        for i in range(kept):
            s = starts[i]
            square = 0.0
            for d in range(size):
                difference = signal[e, d] - signal[s, d]
                square += difference * difference
            value[i] = least[s] + squares[e] - squares[s] - square / (e - s)
            if value[i] + penalty < best:
                best = value[i] + penalty
                start_of[e] = s
        least[e] = best
        still = 0
        for i in range(kept):
            if value[i] <= best and e - starts[i] < longest:
                starts[still] = starts[i]
                still += 1
        starts[still] = e
        kept = still + 1


@njit(nogil=True, cache=True)
def merge_order(means: Floats, weights: Floats, first: Ints, second: Ints) -> None:
    """Ward's merges, cheapest first: merge i joins group second[i] to first[i] < second[i]. Changes its arguments.

    Nearest neighbours are remembered: a merge never makes a third group nearer than it was, so only those whose
    neighbour was one of the two look again. About O(groups²) in all.
    """
    groups = len(weights)
    near = np.zeros(groups, np.int64)
    price = np.full(groups, np.inf)
    alive = np.ones(groups, np.bool_)
    for i in range(groups):
        _nearest(means, weights, alive, i, near, price)
    for merge in range(groups - 1):
        i = int(np.argmin(price))
        j = near[i]
        weight = weights[i] + weights[j]
        for d in range(means.shape[1]):
            means[i, d] = (weights[i] * means[i, d] + weights[j] * means[j, d]) / weight
        weights[i] = weight
        alive[j] = False
        price[j] = np.inf
        first[merge], second[merge] = i, j
        for k in range(groups):
            if alive[k] and (k == i or near[k] == i or near[k] == j):
                _nearest(means, weights, alive, k, near, price)


@njit(nogil=True, cache=True)
def _nearest(means: Floats, weights: Floats, alive: NDArray[np.bool_], i: int, near: Ints, price: Floats) -> None:
    """The cheapest later group to join to group i, and its price: the squared distance lost (Ward 1963)."""
    price[i] = np.inf
    for j in range(i + 1, len(weights)):
        if alive[j]:
            square = 0.0
            for d in range(means.shape[1]):
                difference = means[i, d] - means[j, d]
                square += difference * difference
            lost = square * weights[i] * weights[j] / (weights[i] + weights[j])
            if lost < price[i]:
                price[i] = lost
                near[i] = j
