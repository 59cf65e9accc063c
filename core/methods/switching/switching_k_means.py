"""Settling: assign every step to a motion by Viterbi, take the means of the motions, until nothing changes."""

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
    used, labels = np.unique(labels, return_inverse=True)
    return SwitchingClusters(labels, motion_means(values, labels, len(used)), cost)


def squared_distances(
    values: Float[np.ndarray, "rows D"], squares: Float[np.ndarray, "rows"], means: Float[np.ndarray, "K D"]
) -> Float[np.ndarray, "rows K"]:
    """Squared distances of rows to means; `squares` are the rows' squared lengths."""
    cross = values @ means.T
    cross *= -2
    cross += squares[:, None]
    cross += np.einsum("kd,kd->k", means, means)
    return np.asarray(np.maximum(cross, 0.0, out=cross))


def motion_means(
    values: Float[np.ndarray, "rows D"], labels: Int[np.ndarray, "rows"], count: int
) -> Float[np.ndarray, "K D"]:
    """The mean of the rows of every label 0 … count−1; each label must have some."""
    order = np.argsort(labels, kind="stable")
    starts = np.searchsorted(labels[order], np.arange(count))
    return np.asarray(np.add.reduceat(values[order], starts, axis=0) / np.bincount(labels, minlength=count)[:, None])
