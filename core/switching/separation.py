"""Separation: whether two motions are two, or one cut in half.

The question is local, so it is the same among three motions and among thirty: how far are the two means apart, in
deviations of the motions along the line between them? Halves of one normal cloud are 2.65 apart and of a uniform
one 3.5, however it is turned; motions that a person tells apart were measured at 4 to 35.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from core.switching.signal import WINDOW_SECONDS, Signal

PRIOR_SECONDS = 3.0
"""A short motion says little about its own deviation: so many seconds of the deviation of all are added to it."""


def separations(signal: Signal, labels: Int[np.ndarray, "steps"], count: int) -> Float[np.ndarray, "K K"]:
    """Distance of two motions over the RMS of their deviations along it; infinite on the diagonal."""
    inside = interior(labels, signal.steps(WINDOW_SECONDS / 2))
    clouds = [signal.values[inside & (labels == k)] for k in range(count)]
    means = np.stack([cloud.mean(axis=0) for cloud in clouds])
    scatters = np.stack([np.cov(cloud, rowvar=False, bias=True).reshape(means.shape[1], -1) for cloud in clouds])
    sizes = np.array([len(cloud) for cloud in clouds], np.float64)
    pooled = np.tensordot(sizes / sizes.sum(), scatters, 1)
    prior = PRIOR_SECONDS / signal.seconds_per_step
    scatters = (sizes[:, None, None] * scatters + prior * pooled) / (sizes[:, None, None] + prior)
    line = means[:, None] - means[None]
    length = np.linalg.norm(line, axis=2)
    line /= np.maximum(length, np.finfo(float).tiny)[..., None]
    along = np.einsum("abd,adb->ab", line, scatters @ line.transpose(0, 2, 1))
    apart = length / np.sqrt(np.maximum((along + along.T) / 2, np.finfo(float).tiny))
    np.fill_diagonal(apart, np.inf)
    return np.asarray(apart)


def interior(labels: Int[np.ndarray, "steps"], guard: int) -> Bool[np.ndarray, "steps"]:
    """Steps at least `guard` from every change of label, but always the middle third of a segment."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    inside = np.zeros(len(labels), bool)
    for start, stop in zip(bounds[:-1].tolist(), bounds[1:].tolist(), strict=True):
        margin = min(guard, (stop - start) // 3)
        first = start + margin if start else start
        inside[first : stop - margin if stop < len(labels) else stop] = True
    return inside
