"""Groups by the leading eigenvectors of a likeness (Ng, Jordan and Weiss 2002; normalised cuts, Shi and Malik 2000)."""

import warnings

import numpy as np
from jaxtyping import Float, Int
from scipy.linalg import eigh
from sklearn.cluster import KMeans
from sklearn.exceptions import ConvergenceWarning

STARTS = 50
DIGITS = 9
"""Eigenvalues and rows of eigenvectors that differ by less are the same."""


def cluster_spectrally(kernel: Float[np.ndarray, "n n"], groups: int, seed: int) -> Int[np.ndarray, "n"]:
    """A group 0 … groups−1 for every row; fewer where no more can be told apart."""
    return cluster_rows(spectral_embedding(kernel, groups), groups, seed)


def spectral_embedding(kernel: Float[np.ndarray, "n n"], groups: int) -> Float[np.ndarray, "n d"]:
    """The rows, at unit length, of the `groups` leading eigenvectors of D^−½ K D^−½, D the row sums of K; d is the rank
    of K where that is less.

    Dense, for groups that lie well apart have eigenvalues that are all but equal, and those an iteration misses. O(n³).
    """
    root = 1 / np.sqrt(kernel.sum(axis=1))
    most = min(groups, len(kernel))
    values, vectors = eigh(kernel * root[:, None] * root, subset_by_index=[len(kernel) - most, len(kernel) - 1])
    rows = vectors[:, values > 10.0**-DIGITS]
    length = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.asarray(np.round(rows / np.where(length > 0, length, 1.0), DIGITS))


def cluster_rows(rows: Float[np.ndarray, "n d"], groups: int, seed: int) -> Int[np.ndarray, "n"]:
    """k-means with 50 starts; no more groups than rows that differ."""
    different, which = np.unique(rows, axis=0, return_inverse=True)
    if len(different) <= groups:
        return np.asarray(which, np.int64)
    if groups == 1:
        return np.zeros(len(rows), np.int64)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)  # rows all but the same: fewer groups, as the caller sees
        fit = KMeans(groups, init="random", n_init=STARTS, max_iter=100, random_state=seed).fit(rows)
    return np.asarray(fit.labels_, np.int64)
