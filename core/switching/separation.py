"""Separation: whether two motions are two, or one cut in half.

The question is local, so it is the same among three motions and among thirty, where every share of the whole fails:
how far are two means apart, against how far the steps of each motion stray from its mean?
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from core.switching.signal import WINDOW_SECONDS, Signal

APART = 4.5
"""Distance in deviations along the line of the means. Halves of one motion reach 2.65 where it strays normally, 3.46
uniformly, and 4.13 where it swings like a pendulum, which is the widest of the three."""
BEYOND = 1.7
"""Distance in deviations in all directions together: repetitions of one motion, each at its own speed and size, were
measured at 0.5 to 2.0, and two motions at 1.5 to 30."""
PRIOR_SECONDS = 12.0
"""A motion seen briefly says little about how it strays: so many seconds of the straying of all motions are added."""


def separations(signal: Signal, labels: Int[np.ndarray, "steps"], count: int) -> Float[np.ndarray, "K K"]:
    """How much farther apart two motions are than one cut in half would be: 1 or more is two; infinite on the diagonal.

    The lesser of distance / (`APART` · deviation along the line of the means) and distance / (`BEYOND` · deviation).
    Steps near a change are left out: there the window holds both motions.
    """
    inside = interior(labels, signal.steps(WINDOW_SECONDS / 2))
    clouds = [signal.values[inside & (labels == k)] for k in range(count)]
    means = np.stack([cloud.mean(axis=0) for cloud in clouds])
    scatters = _scatters(clouds, PRIOR_SECONDS / signal.seconds_per_step)
    line = means[:, None] - means[None]
    length = np.linalg.norm(line, axis=2)
    line /= np.maximum(length, _TINY)[..., None]
    along = np.einsum("abd,adb->ab", line, scatters @ line.transpose(0, 2, 1))
    around = np.trace(scatters, axis1=1, axis2=2)
    apart = length / (APART * _deviation(along, along.T))
    beyond = length / (BEYOND * _deviation(around[:, None], around[None]))
    separation = np.minimum(apart, beyond)
    np.fill_diagonal(separation, np.inf)
    return np.asarray(separation)


def interior(labels: Int[np.ndarray, "steps"], guard: int) -> Bool[np.ndarray, "steps"]:
    """Steps at least `guard` from every change of label, but always the middle third of a segment."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    inside = np.zeros(len(labels), bool)
    for start, stop in zip(bounds[:-1].tolist(), bounds[1:].tolist(), strict=True):
        margin = min(guard, (stop - start) // 3)
        inside[start + margin if start else start : stop - margin if stop < len(labels) else stop] = True
    return inside


_TINY = float(np.finfo(np.float64).tiny)


def _scatters(clouds: list[Float[np.ndarray, "_ D"]], prior: float) -> Float[np.ndarray, "K D D"]:
    """The covariance of every cloud, with `prior` steps' worth of that of all of them mixed in."""
    sizes = np.array([len(cloud) for cloud in clouds], np.float64)[:, None, None]
    centred = [cloud - cloud.mean(axis=0) for cloud in clouds]
    sums = np.stack([cloud.T @ cloud for cloud in centred])
    pooled = sums.sum(axis=0) / sizes.sum()
    return np.asarray((sums + prior * pooled) / (sizes + prior))


def _deviation(one: Float[np.ndarray, "..."], other: Float[np.ndarray, "..."]) -> Float[np.ndarray, "K K"]:
    """The RMS of two motions' deviations, from their variances."""
    return np.asarray(np.sqrt(np.maximum((one + other) / 2, _TINY)))
