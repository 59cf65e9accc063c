"""Initial segments: the take cut wherever its features change, before anybody knows which motion is which.

Motions are then groups of long stretches. This start is found the same way every time and was measured to be better
than random ones: the lowest cost over many random starts often spends a motion on the blur between two others.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.kernels import switching
from caesura.core.methods.switching.windowed_signal import WindowedSignal

LONGEST_SECONDS = 30.0
"""A longer stretch comes in pieces; it bounds the work on takes in which nothing happens."""
MOST = 2000
HALVINGS = 10


@dataclass(frozen=True)
class InitialSegments:
    """Means and lengths of the long stretches, and the merges that make fewer and fewer groups of them."""

    means: Float[np.ndarray, "stretches D"]
    lengths: Float[np.ndarray, "stretches"]
    first: Int[np.ndarray, "merges"]
    second: Int[np.ndarray, "merges"]

    @classmethod
    def of(cls, signal: WindowedSignal, penalty: float, at_least: int = 1) -> "InitialSegments":
        """The stretches of least squared distance to their means + `penalty` each, and Ward's order of merging them.

        Only those as long as a window take part: a shorter one is the blur between two. Where `at_least` so many
        are asked for, shorter ones do too, and the penalty is lowered until there are enough, if that is possible.
        """
        total = np.zeros((len(signal.values) + 1, signal.values.shape[1]))
        np.cumsum(signal.values, axis=0, out=total[1:])
        bounds = _segment_bounds(signal, total, penalty)
        for halving in range(HALVINGS):
            if len(bounds) > at_least:
                break
            bounds = _segment_bounds(signal, total, penalty / 2 ** (halving + 1))
        lengths = np.diff(bounds)
        long = int(np.count_nonzero(lengths >= signal.window))
        chosen = np.sort(np.argsort(-lengths, kind="stable")[: max(min(long, MOST), at_least)])
        means = (total[bounds[1:]] - total[bounds[:-1]])[chosen] / lengths[chosen, None]
        weights = lengths[chosen].astype(np.float64)
        first, second = np.zeros(len(chosen) - 1, np.int64), np.zeros(len(chosen) - 1, np.int64)
        switching.merge_order(means.copy(), weights.copy(), first, second)
        return cls(means, weights, first, second)

    def __len__(self) -> int:
        return len(self.lengths)

    def grouped(self, count: int) -> Float[np.ndarray, "groups D"]:
        """The means of `count` groups of stretches, or of as many as there are stretches."""
        group = np.arange(len(self))
        for a, b in zip(self.first.tolist(), self.second.tolist()[: max(len(self) - count, 0)], strict=False):
            group[group == b] = a
        names = np.unique(group)
        weights = self.lengths * (group == names[:, None])
        return np.asarray(weights @ self.means / weights.sum(axis=1)[:, None])


def _segment_bounds(
    signal: WindowedSignal, total: Float[np.ndarray, "sums D"], penalty: float
) -> Int[np.ndarray, "bounds"]:
    """Where the stretches begin, and where the last one ends."""
    squares = np.concatenate([[0.0], np.cumsum(np.einsum("sd,sd->s", signal.values, signal.values))])
    start_of = np.zeros(len(total), np.int64)
    switching.least_cost_partition(total, squares, penalty, signal.steps(LONGEST_SECONDS), start_of)
    bounds = [len(signal.values)]
    while bounds[-1] > 0:
        bounds.append(int(start_of[bounds[-1]]))
    return np.array(bounds[::-1])
