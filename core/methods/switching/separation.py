"""Separation: whether two motions are two, or one cut in half.

The question is local, so it is the same among three motions and among thirty, where every share of the whole fails:
how far are two means apart, against how far the steps of each motion stray from its mean?
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from caesura.core.methods.switching.windowed_signal import WINDOW_SECONDS, WindowedSignal

APART = 3.25
"""Distance in deviations along the line of the means. Halves of a motion that strays normally are 2.65 apart, and the
halves of a swing 4.1, which the prior below brings under this. Measured on 96 takes of 1 to 30 motions: 2.75 to 3.75
count equally well, and right in 90 of them or more."""
BEYOND = 1.0
"""Distance in deviations in all directions together: two motions lie outside each other's cloud."""
NEAR = 0.3
"""Distance at which two performances of one motion may lie, by the habits of that day, where all steps lie 1 from the
mean of all: measured on 119 takes, 95 in 100 lie nearer, and 95 in 100 motions farther from the next. It halved the
takes in which a motion was taken for two; 0.3 to 0.4 count equally well."""
PERFORMANCE = 0.15
"""One performance of a motion is larger or faster than the next by about so much (standard deviation)."""
PRIOR_SECONDS = 12.0
"""A motion seen briefly says little about how it strays: so many seconds of the straying of all motions are added."""


def measure_separations(
    signal: WindowedSignal, labels: Int[np.ndarray, "steps"], count: int
) -> Float[np.ndarray, "K K"]:
    """How much farther apart two motions are than one cut in half would be: 1 or more is two; infinite on the diagonal.

    The least of distance / (`APART` · deviation along the line of the means), distance / (`BEYOND` · deviation) and
    distance / `NEAR`.
    Steps near a change are left out: there the window holds both motions.
    """
    inside = find_interior_steps(labels, signal.steps(WINDOW_SECONDS / 2))
    members = [inside & (labels == k) for k in range(count)]
    means = np.stack([signal.values[of_motion].mean(axis=0) for of_motion in members])
    scatters = _motion_scatters(signal, members, PRIOR_SECONDS / signal.seconds_per_step)
    line = means[:, None] - means[None]
    length = np.linalg.norm(line, axis=2)
    line /= np.maximum(length, _TINY)[..., None]
    along = np.einsum("abd,adb->ab", line, scatters @ line.transpose(0, 2, 1))
    around = np.trace(scatters, axis1=1, axis2=2)
    apart = length / (APART * _deviation(along, along.T))
    beyond = length / (BEYOND * _deviation(around[:, None], around[None]))
    separation = np.minimum(np.minimum(apart, beyond), length / NEAR)
    np.fill_diagonal(separation, np.inf)
    return np.asarray(separation)


def find_interior_steps(labels: Int[np.ndarray, "steps"], guard: int) -> Bool[np.ndarray, "steps"]:
    """Steps at least `guard` from every change of label, but always the middle third of a segment."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    inside = np.zeros(len(labels), bool)
    for start, stop in zip(bounds[:-1].tolist(), bounds[1:].tolist(), strict=True):
        margin = min(guard, (stop - start) // 3)
        inside[start + margin if start else start : stop - margin if stop < len(labels) else stop] = True
    return inside


_TINY = float(np.finfo(np.float64).tiny)


def _motion_scatters(
    signal: WindowedSignal, members: list[Bool[np.ndarray, "steps"]], prior: float
) -> Float[np.ndarray, "K D D"]:
    """How the steps of every motion stray, with `prior` steps' worth of how all do, and how performances differ."""
    sizes = np.array([np.count_nonzero(of_motion) for of_motion in members], np.float64)[:, None, None]
    centred = [signal.values[of_motion] - signal.values[of_motion].mean(axis=0) for of_motion in members]
    sums = np.stack([cloud.T @ cloud for cloud in centred])
    scatters = (sums + prior * sums.sum(axis=0) / sizes.sum()) / (sizes + prior)
    for direction in (signal.size, signal.tempo):
        ways = PERFORMANCE * np.stack([direction[of_motion].mean(axis=0) for of_motion in members])
        scatters += ways[:, :, None] * ways[:, None, :]
    return np.asarray(scatters)


def _deviation(one: Float[np.ndarray, "..."], other: Float[np.ndarray, "..."]) -> Float[np.ndarray, "K K"]:
    """The RMS of two motions' deviations, from their variances."""
    return np.asarray(np.sqrt(np.maximum((one + other) / 2, _TINY)))
