"""Switching k-means: assign every step to a motion by Viterbi, take the means of the motions, until nothing changes."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.core.kernels import switching

PASSES = 50


@dataclass(frozen=True)
class SwitchingClusters:
    """Labels of the steps, the mean of each motion, and what it costs: Σ squared distance + penalty · changes."""

    labels: Int[np.ndarray, "steps"]
    means: Float[np.ndarray, "K D"]
    cost: float

    @property
    def motions(self) -> int:
        """How many motions are in use."""
        return len(self.means)


def run_switching_k_means(
    values: Float[np.ndarray, "steps D"], means: Float[np.ndarray, "K D"], penalty: float
) -> SwitchingClusters:
    """Alternate from the given means to a fixed point, O(steps · K) a pass; the cost never rises.

    A motion that no step wants is dropped, so that fewer than K may come back.
    """
    squares = np.einsum("sd,sd->s", values, values)
    settled = _run_once(values, squares, means, penalty)
    for _ in range(PASSES - 1):
        again = _run_once(values, squares, settled.means, penalty)
        if again.cost >= settled.cost * (1 - 1e-9):
            break
        settled = again
    return settled


def _run_once(
    values: Float[np.ndarray, "steps D"],
    squares: Float[np.ndarray, "steps"],
    means: Float[np.ndarray, "K D"],
    penalty: float,
) -> SwitchingClusters:
    """The cheapest labels for these means, and the means of those labels."""
    labels = np.empty(len(values), np.int64)
    cost = switching.viterbi(squared_distances(values, squares, means), penalty, labels)
    used = np.bincount(labels, minlength=len(means)) > 0
    labels = (np.cumsum(used) - 1)[labels]
    return SwitchingClusters(labels, motion_means(values, labels, int(used.sum())), cost)


def squared_distances(
    values: Float[np.ndarray, "rows D"], squares: Float[np.ndarray, "rows"], means: Float[np.ndarray, "K D"]
) -> Float[np.ndarray, "rows K"]:
    """Squared distances of rows to means; `squares` are the rows' squared lengths."""
    products = values @ (-2 * means.T)
    switching.squares_from_products(products, squares, np.einsum("kd,kd->k", means, means))
    return np.asarray(products)


def motion_means(
    values: Float[np.ndarray, "rows D"], labels: Int[np.ndarray, "rows"], count: int
) -> Float[np.ndarray, "K D"]:
    """The mean of the rows of every label 0 … count−1; each label must have some."""
    sums = np.zeros((count, values.shape[1]))
    switching.add_by_label(np.ascontiguousarray(values), labels, sums)
    return sums / np.bincount(labels, minlength=count)[:, None]
