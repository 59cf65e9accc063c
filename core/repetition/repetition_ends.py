"""Repetition ends: where each repetition ends."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.kernels import repetition

FASTEST, SLOWEST = 0.67, 1.5
"""One repetition against the period of the passage."""
EVENNESS = 0.5
"""What it costs to be faster or slower: this times the squared logarithm, against differences at unit mean."""
RESOLUTION = 32
"""Places in a repetition that are told apart, so that slow motions cost no more than fast ones."""


def find_repetition_ends(
    passage: Float[np.ndarray, "frames d"], period: int, prices: Float[np.ndarray, "frames"]
) -> Int[np.ndarray, "bounds"]:
    """0, the frames at which repetitions end, and the number of frames.

    The ends that make the frames around each most like those around the next, and the repetitions even; exact, by
    dynamic programming over all ends and lengths. `prices` are what it costs to end at a frame, for each frame of the
    period.
    """
    stride = max(period // RESOLUTION, 1)
    seen = passage[::stride]
    lags = np.arange(max(int(FASTEST * period / stride), 1), int(np.ceil(SLOWEST * period / stride)) + 1)
    lags = lags[lags < len(seen)]
    uneven = EVENNESS * np.log(lags * stride / period) ** 2
    cost = (_frame_differences(seen, lags, max(period // stride // 4, 1)) + uneven) * lags
    cost[1:-1] += prices[::stride][1:, None] * (period / stride)
    came_from = np.full(len(seen) + 1, -1, np.int64)
    repetition.cheapest_repetition_ends(cost, lags, came_from)
    bounds = [len(seen)]
    while bounds[-1] > 0 and came_from[bounds[-1]] >= 0:
        bounds.append(int(came_from[bounds[-1]]))
    inner = bounds[-2:0:-1] if bounds[-1] == 0 else []
    return np.array([0, *(i * stride for i in inner), len(passage)])


def _frame_differences(
    seen: Float[np.ndarray, "places d"], lags: Int[np.ndarray, "lags"], around: int
) -> Float[np.ndarray, "ends lags"]:
    """[e, i]: how unlike the places around e are to those a lag earlier; 1 is as unlike as two places at random.

    The last end is that of the passage: it is judged by the place before it.
    """
    found = np.zeros((len(seen) + 1, len(lags)))
    repetition.mean_differences(np.ascontiguousarray(seen), lags, around, found)
    return found / (2 * float(np.einsum("pd,pd->", seen, seen)) / len(seen))
