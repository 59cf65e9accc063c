"""Certainty: what dropping a cut would cost, and whether the segments beside it were seen at all.

What moving it would cost is told by the refinement; the geometric mean of both says which cuts to look at first.
"""

import numpy as np
from jaxtyping import Float

from caesura.core.methods.switching.motion_count import SHORTEST_SECONDS
from caesura.core.methods.switching.switching_k_means import SwitchingClusters, squared_distances
from caesura.core.methods.switching.windowed_signal import WindowedSignal


def cut_confidence(signal: WindowedSignal, settled: SwitchingClusters, penalty: float) -> Float[np.ndarray, "cuts"]:
    """For every cut, 0 to 1: how much dearer the take would be without it.

    Without the cut, the dearer of the two sides to win over joins the motion of the cheaper one: the cost rises by
    the least Σ (distance to the other motion − distance to its own) of the two segments, and one change is saved.
    rise / (rise + penalty): 0.5 where a cut earns just what a change costs again, near 1 where it is beyond doubt.
    Times the share of `SHORTEST_SECONDS` that the shorter segment beside it lasts: of a shorter one windows show no
    more than a blur.
    """
    labels = settled.labels
    cuts = np.flatnonzero(np.diff(labels)) + 1
    squares = np.einsum("sd,sd->s", signal.values, signal.values)
    cost = squared_distances(signal.values, squares, settled.means)
    total = np.concatenate([np.zeros((1, cost.shape[1])), np.cumsum(cost, axis=0)])
    bounds = np.concatenate([[0], cuts, [len(labels)]])
    spent = total[bounds[1:]] - total[bounds[:-1]]
    motion = labels[bounds[:-1]]
    here = np.arange(len(cuts))
    own = spent[np.arange(len(motion)), motion]
    left_gives_way = spent[here, motion[1:]] - own[:-1]
    right_gives_way = spent[here + 1, motion[:-1]] - own[1:]
    rise = np.maximum(np.minimum(left_gives_way, right_gives_way), 0.0)
    lengths = np.diff(bounds)
    seen = np.minimum(np.minimum(lengths[:-1], lengths[1:]) / signal.steps(SHORTEST_SECONDS), 1.0)
    return np.asarray(seen * rise / (rise + penalty))
