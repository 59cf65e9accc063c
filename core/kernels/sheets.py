"""The compiled loops of sheets: linear in the number of samples."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}  # never nnan or ninf: they delete finiteness checks

Floats = NDArray[np.float64]


@njit(nogil=True, cache=True, fastmath=FAST)
def clip_costs(
    poses: Floats,
    sums: Floats,
    squares: Floats,
    speed: float,
    rounding: float,
    spread_weight: float,
    floor: float,
    shortest: int,
    out: NDArray[np.float32],
) -> None:
    """out[s, n]: what a clip of n samples from sample s costs; infinite where it is too short or does not fit.

    ln of the distance from its last pose to its first, against `speed`, the distance of one sample at the usual speed,
    or against the farthest pose from its first where that is nearer; + `spread_weight` · n · ½ Σ ln of the variance in
    each direction, against that of the whole take. `sums` and `squares` are running sums of the poses and of their
    squares. The pose after the last one may close the clip as well, for some timelines share it between neighbours.
    """
    samples, size = poses.shape
    whole = 0.0
    for d in range(size):
        mean = sums[samples, d] / samples
        whole += np.log(max(squares[samples, d] / samples - mean * mean, 0.0) + floor)
    longest = out.shape[1] - 1
    for s in range(samples):
        farthest, seen = 0.0, s
        out[s, :] = np.inf
        for n in range(shortest, min(longest, samples - s) + 1):
            e = s + n
            while seen < e:
                farthest = max(farthest, _square(poses, s, seen))
                seen += 1
            open_square = min(_square(poses, s, e - 1), _square(poses, s, min(e, samples - 1)))
            spread = -whole
            for d in range(size):
                mean = (sums[e, d] - sums[s, d]) / n
                variance = (squares[e, d] - squares[s, d]) / n - mean * mean
                spread += np.log(max(variance, 0.0) + floor)
            moved = min(np.sqrt(farthest) / speed, 1.0)
            closed = np.log((np.sqrt(open_square) / speed + rounding) / (moved + rounding))
            out[s, n] = closed + spread_weight * n * 0.5 * spread


@njit(nogil=True, cache=True, fastmath=FAST)
def _square(poses: Floats, i: int, j: int) -> float:
    total = 0.0
    for d in range(poses.shape[1]):
        difference = poses[i, d] - poses[j, d]
        total += difference * difference
    return total


@njit(nogil=True, cache=True)
def divide(
    costs: NDArray[np.float32],
    reward: Floats,
    gap: Floats,
    penalty: float,
    before: Floats,
    lengths: NDArray[np.int16],
    gaps: NDArray[np.int16],
    chained: bool,
) -> float:
    """The cheapest clips that end at each sample, and the cost of the whole.

    A clip costs `costs` + `penalty` − `reward` at its first sample; between two there may be a gap of g samples, which
    costs gap[g]. `before[e]` is the least cost of what precedes a clip at sample e; where `chained`, clips of this
    very pass precede as well. At the end `before` holds the least costs that end at e, with a gap or without.
    `lengths[e]` and `gaps[e]`: the last clip before e and the gap after it.
    """
    samples, longest = len(costs), costs.shape[1] - 1
    ended = np.full(samples + 1, np.inf)
    after = np.full(samples + 1, np.inf)
    for e in range(samples + 1):
        for n in range(1, min(longest, e) + 1):
            s = e - n
            least = min(before[s], after[s]) if chained else before[s]
            value = least + costs[s, n] + penalty - (reward[s] if s > 0 else 0.0)
            if value < ended[e]:
                ended[e] = value
                lengths[e] = n
        after[e] = ended[e]
        for g in range(1, min(len(gap) - 1, e) + 1):
            if ended[e - g] + gap[g] < after[e]:
                after[e] = ended[e - g] + gap[g]
                gaps[e] = g
    before[:] = after
    return float(after[samples])
