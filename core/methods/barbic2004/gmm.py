"""Frames by the Gaussian of a mixture that they are most likely of (Barbič et al. 2004, section 3.3)."""

import warnings

import numpy as np
from jaxtyping import Float, Int
from sklearn.exceptions import ConvergenceWarning
from sklearn.mixture import GaussianMixture

from caesura.core.analysis import Analysis
from caesura.core.methods.alignment.short_runs import remove_short_runs
from caesura.core.methods.comparison_steps import cut_by_compared_method
from caesura.core.parameters import Parameters
from caesura.core.segmentation import Cut

MOST_FRAMES = 50_000
KEPT = 0.9
"""Share of the variance in the dimensions that are looked at (τ)."""
STARTS = 5
SHORTEST_SECONDS = 1.0
"""A shorter run is noise, and goes to the motions beside it."""
ROUNDING = 1e-6


def gmm(analysis: Analysis, parameters: Parameters) -> Cut:
    """Cut a take where its frames pass from one of K Gaussians to another for a second at least."""
    return cut_by_compared_method(analysis, parameters, _label_frames, MOST_FRAMES)


def _label_frames(
    values: Float[np.ndarray, "frames D"], frame_rate: float, motions: int, seed: int
) -> Int[np.ndarray, "frames"]:
    return remove_short_runs(label_by_mixture(values, motions, seed), max(round(SHORTEST_SECONDS * frame_rate), 1))


def label_by_mixture(values: Float[np.ndarray, "frames D"], motions: int, seed: int) -> Int[np.ndarray, "frames"]:
    """The likeliest Gaussian of each frame, of a mixture fitted by expectation maximisation, linear in the frames."""
    poses = leading_dimensions(values)
    groups = min(motions, len(np.unique(poses, axis=0)))
    if groups < 2:
        return np.zeros(len(values), np.int64)
    mixture = GaussianMixture(groups, n_init=STARTS, random_state=seed, reg_covar=ROUNDING)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)  # a hundred steps are enough to label frames
        return np.asarray(mixture.fit_predict(poses), np.int64)


def leading_dimensions(values: Float[np.ndarray, "frames D"]) -> Float[np.ndarray, "frames d"]:
    """As few principal components as keep `KEPT` of the variance, the first at unit variance."""
    centred = values - values.mean(axis=0, dtype=np.float64)
    variances, directions = np.linalg.eigh(centred.T @ centred / len(centred))
    kept = int(np.searchsorted(np.cumsum(variances[::-1]), KEPT * variances.sum())) + 1
    spread = np.sqrt(max(float(variances[-1]), np.finfo(float).tiny))
    return np.asarray(centred @ directions[:, ::-1][:, :kept] / spread)
