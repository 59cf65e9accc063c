"""A hidden Markov model of windows (Kohlmorgen and Lemm 2001, as Janus and Nakamura 2005 use it; the paper's [10]).

The poses in a window are a density: the mean of Gaussians about them. Every window of the take is a state, whose
density the others are compared with by the integrated squared difference. The path of states of least cost, where each
change costs C besides, cuts the take; states that are alike are then one motion.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform

from caesura.core.analysis import Analysis
from caesura.core.kernels import switching
from caesura.core.methods.alignment.frame_kernel import frame_kernel
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 10_000
SAMPLES_PER_SECOND = 10.0
MOST_SAMPLES = 4000
"""A take of few frames a second has as many samples as frames."""
WINDOW_SECONDS = 2.0
CHANGE_SECONDS = 2.0
"""C: a change costs as much as two seconds at the mean difference of two windows."""
HALVINGS = 12


def hidden_markov(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where the density of its poses passes from one state to another, and put states into K motions."""
    return cut_by_compared_method(analysis, parameters, _label_frames, MOST_FRAMES)


def _label_frames(
    values: Float[np.ndarray, "frames D"],
    frame_rate: float,
    motions: int,
    seed: int,  # noqa: ARG001 -- no randomness
) -> Int[np.ndarray, "frames"]:
    stride = max(round(frame_rate / SAMPLES_PER_SECOND), -(-len(values) // MOST_SAMPLES), 1)
    sampled = values[stride // 2 :: stride] if len(values) > stride else values[:1]
    seconds = stride / frame_rate
    apart = density_differences(sampled, max(round(WINDOW_SECONDS / seconds / 2), 1))
    states = find_states(apart, CHANGE_SECONDS / seconds * float(apart.mean()), motions)
    return np.asarray(np.repeat(group_states(apart, states, motions), stride).take(np.arange(len(values)), mode="clip"))


def density_differences(sampled: Float[np.ndarray, "samples D"], half: int) -> Float[np.ndarray, "samples samples"]:
    """∫ (p_s − p_t)² of the windows of `half` samples on either side of s and t, but for a constant factor.

    Windows are cut short at the ends. O(samples²) time and memory, by running sums.
    """
    count = len(sampled)
    start, stop = np.maximum(np.arange(count) - half, 0), np.minimum(np.arange(count) + half + 1, count)
    sums = np.zeros((count + 1, count + 1))
    np.cumsum(np.cumsum(frame_kernel(sampled), axis=0), axis=1, out=sums[1:, 1:])
    within = sums[stop] - sums[start]
    shared = (within[:, stop] - within[:, start]) / np.outer(stop - start, stop - start)
    own = np.diag(shared)
    return np.asarray(np.maximum(own[:, None] + own - 2 * shared, 0.0))


def find_states(
    apart: Float[np.ndarray, "samples samples"], change: float, at_least: int
) -> Int[np.ndarray, "samples"]:
    """The state of every sample on the path of least Σ difference + `change` · changes (Viterbi), O(samples²).

    Where that has fewer than `at_least` states, changes cost half as much, and half again.
    """
    states = np.zeros(len(apart), np.int64)
    for _ in range(HALVINGS):
        switching.viterbi(np.ascontiguousarray(apart), change, states)
        if len(np.unique(states)) >= at_least:
            break
        change /= 2
    return states


def group_states(
    apart: Float[np.ndarray, "samples samples"], states: Int[np.ndarray, "samples"], motions: int
) -> Int[np.ndarray, "samples"]:
    """A motion for every sample: the states whose densities differ least are joined until `motions` are left."""
    used, place = np.unique(states, return_inverse=True)
    if len(used) == 1:
        return np.zeros(len(states), np.int64)
    tree = linkage(squareform(np.sqrt(apart[np.ix_(used, used)]), checks=False), "average")
    return np.asarray(fcluster(tree, motions, "maxclust")[place] - 1, np.int64)
