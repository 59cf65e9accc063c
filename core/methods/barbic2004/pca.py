"""Cuts where the projection error of principal components rises (Barbič et al. 2004, section 3.1)."""

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.segment_groups import cut_by_bounds
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 100_000
FIRST_SECONDS = 2.0
"""240 frames of theirs: so many say how many dimensions the motion has."""
LAG_SECONDS = 0.5
"""60 frames of theirs, over which the rise of the error is taken."""
KEPT = 0.9
"""Share of the variance that these dimensions keep (τ)."""
DEVIATIONS = 3.0
"""A rise by so many deviations above the mean of those before it is a cut."""
AT_ONCE = 64


def pca(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its poses leave the hyperplane of those before, and put segments alike into K motions."""
    return cut_by_bounds(analysis, parameters, find_pca_bounds, MOST_FRAMES)


def find_pca_bounds(values: Float[np.ndarray, "frames D"], frame_rate: float) -> Int[np.ndarray, "bounds"]:
    """Where segments begin, and where the last one ends.

    In a segment that begins at s, e_i is the squared distance of its first i frames, in all, to their own hyperplane of
    r dimensions, and d_i = e_i − e_{i−l}. The first frame at which d_i exceeds the mean of those before it by three
    deviations begins the next segment. Linear in the frames: a matrix of D × D for each.
    """
    first, lag = max(round(FIRST_SECONDS * frame_rate), 2), max(round(LAG_SECONDS * frame_rate), 1)
    bounds = [0]
    while len(values) - bounds[-1] > first + 2 * lag:
        found = _find_rise(values[bounds[-1] :], first, lag)
        if found is None:
            break
        bounds.append(bounds[-1] + found)
    return np.array([*bounds, len(values)])


def _find_rise(values: Float[np.ndarray, "frames D"], first: int, lag: int) -> int | None:
    dimensions, errors = 0, np.empty(0)
    scatter, total = np.zeros((values.shape[1], values.shape[1])), np.zeros(values.shape[1])
    values = values - values[:first].mean(axis=0)
    for start in range(first, len(values) + 1, AT_ONCE):
        counts = np.arange(start, min(start + AT_ONCE, len(values) + 1))
        done = 0 if start == first else start - 1
        steps = np.einsum("fi,fj->fij", values[done : counts[-1]], values[done : counts[-1]])
        scatters = scatter + np.cumsum(steps, axis=0)
        totals = total + np.cumsum(values[done : counts[-1]], axis=0)
        scatter, total = scatters[-1], totals[-1]
        of = slice(counts[0] - 1 - done, None)
        centred = scatters[of] - np.einsum("fi,fj->fij", totals[of], totals[of]) / counts[:, None, None]
        variances = np.maximum(np.linalg.eigvalsh(centred), 0)[:, ::-1]
        if start == first:
            dimensions = int(np.searchsorted(np.cumsum(variances[0]), KEPT * variances[0].sum())) + 1
        known = len(errors)
        errors = np.concatenate([errors, variances[:, dimensions:].sum(axis=1)])
        for i in range(max(known, 2 * lag), len(errors)):
            rises = errors[lag:i] - errors[: i - lag]
            if errors[i] - errors[i - lag] > rises.mean() + DEVIATIONS * rises.std() + _rounding(variances[0]):
                return first + i - 1
    return None


def _rounding(variances: Float[np.ndarray, "D"]) -> float:
    return 1e-9 * float(variances.sum())
