"""Cuts where the frames ahead leave the distribution of those behind: probabilistic PCA (Barbič et al. 2004, 3.2)."""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float, Int

from caesura.core.analysis import Analysis
from caesura.core.methods.segment_groups import cut_by_bounds
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 100_000
FIRST_SECONDS = 1.25
"""150 frames of theirs: the least that a distribution is made of, and also how far ahead of it is looked (T)."""
STEP_SECONDS = 1 / 12
"""10 frames of theirs, by which the distribution grows (Δ)."""
KEPT = 0.95
"""Share of the variance in the dimensions that are not taken for noise (τ)."""
RISE = 0.1
"""What a peak must rise above the valley before it, as a share of the range of H (R)."""
FLOOR = 1e-6
"""Variance, as a share of that of the whole take, below which it is rounding: poses that are held have none."""


def ppca(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where the distribution of its poses changes, and put segments that are alike into K motions."""
    return cut_by_bounds(analysis, parameters, find_ppca_bounds, MOST_FRAMES)


def find_ppca_bounds(values: Float[np.ndarray, "frames D"], frame_rate: float) -> Int[np.ndarray, "bounds"]:
    """Where segments begin, and where the last one ends; linear in the frames.

    In a segment that begins at s, H(K) is the mean squared Mahalanobis distance of the frames K to K + T to the
    Gaussian of the frames s to K. A valley of H and a peak that is higher by R are a cut at the K of the peak. The peak
    is known once H has fallen by R again. R is a tenth of the range of H when nothing is cut.
    """
    ahead, step = max(round(FIRST_SECONDS * frame_rate), 2), max(round(STEP_SECONDS * frame_rate), 1)
    floor = FLOOR * float(values.var(axis=0).sum())
    uncut = [height for _, height in distances_ahead(values, ahead, step, floor)]
    if not uncut:
        return np.array([0, len(values)])
    rise, bounds = RISE * (max(uncut) - min(uncut)), [0]
    while True:
        found = _find_peak(distances_ahead(values[bounds[-1] :], ahead, step, floor), rise)
        if found is None:
            return np.array([*bounds, len(values)])
        bounds.append(bounds[-1] + found)


def _find_peak(curve: Iterator[tuple[int, float]], rise: float) -> int | None:
    valley, peak, at = np.inf, -np.inf, None
    for frames, height in curve:
        if height < valley:
            valley, peak, at = height, -np.inf, None
        elif height - valley > rise and height > peak:
            peak, at = height, frames
        if at is not None and peak - height > rise:
            return at
    return None


def distances_ahead(
    values: Float[np.ndarray, "frames D"], ahead: int, step: int, floor: float
) -> Iterator[tuple[int, float]]:
    """K and H(K) for K = T, T + Δ, … as long as T frames follow; no variance counts as less than `floor`."""
    size = values.shape[1]
    scatter, total, done = np.zeros((size, size)), np.zeros(size), 0
    values = values - values[:ahead].mean(axis=0)
    for frames in range(ahead, len(values) - ahead + 1, step):
        scatter += values[done:frames].T @ values[done:frames]
        total, done = total + values[done:frames].sum(axis=0), frames
        mean = total / frames
        covariance = scatter / frames - np.outer(mean, mean)
        yield frames, _mean_distance(values[frames : frames + ahead] - mean, covariance, floor)


def _mean_distance(apart: Float[np.ndarray, "T D"], covariance: Float[np.ndarray, "D D"], floor: float) -> float:
    """The mean of xᵀ C⁻¹ x; C is the covariance with the variances beyond the leading ones replaced by their mean."""
    variances, directions = np.linalg.eigh(covariance)
    variances = np.maximum(variances, 0)
    kept = int(np.searchsorted(np.cumsum(variances[::-1]), KEPT * variances.sum())) + 1
    noise = variances[:-kept].mean() if kept < len(variances) else variances[0]
    is_noise = np.arange(len(variances)) < len(variances) - kept
    model = np.maximum(np.where(is_noise, noise, variances), max(floor, np.finfo(float).tiny))
    return float((np.square(apart @ directions) / model).sum(axis=1).mean())
