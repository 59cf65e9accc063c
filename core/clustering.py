"""Key-frames into motions (paper, section 4.1): K-means on their strain, K given or chosen."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from sklearn.cluster import KMeans
from sklearn.metrics import silhouette_score
from threadpoolctl import threadpool_limits

from core.document import Score

STARTS = 20
MOST_MOTIONS = 20
LEAST_SILHOUETTE = 0.25
"""Below this a grouping is "no substantial structure" (Kaufman and Rousseeuw, 1990): then all is one motion."""

SILHOUETTE_SAMPLE = 2000
MOST_IN_GRAM = 1500


@dataclass(frozen=True)
class Clusters:
    """`labels` (keys,), and for each key how clearly it belongs there: 1 − (own centre's distance / next centre's)."""

    labels: Int[np.ndarray, "keys"]
    margin: Float[np.ndarray, "keys"]
    inertia: float


def cluster(points: Float[np.ndarray, "keys D"], motions: int, seed: int) -> Clusters:
    """K-means with 20 starts and a fixed seed, on one thread: the same labels for any number of threads."""
    points = compact(points)
    with threadpool_limits(1):
        fit = KMeans(motions, n_init=STARTS, random_state=seed).fit(points)
        distance = np.sort(fit.transform(points), axis=1)
    margin = np.ones(len(points))
    if motions > 1:
        margin = 1 - distance[:, 0] / np.maximum(distance[:, 1], np.finfo(np.float32).tiny)
    return Clusters(fit.labels_.astype(np.int64), margin.astype(np.float64), float(fit.inertia_))


def compact(points: Float[np.ndarray, "keys D"]) -> Float[np.ndarray, "keys d"]:
    """The same points in as few dimensions as they span: distances, which are all that K-means sees, stay.

    By the eigenvectors of the Gram matrix of the centred points, where they are fewer than their dimensions and
    few enough for it to be quick.
    """
    if not 1 < len(points) < min(points.shape[1], MOST_IN_GRAM):
        return points
    centred = points - points.mean(axis=0, dtype=np.float64)
    with threadpool_limits(1):
        squared, directions = np.linalg.eigh(centred @ centred.T)
    spanned = squared > squared[-1] * np.finfo(np.float64).eps
    return np.asarray(directions[:, spanned] * np.sqrt(squared[spanned]))


def distinct(points: Float[np.ndarray, "keys D"]) -> int:
    """How many different points there are: no more clusters than that."""
    return len(np.unique(points, axis=0))


def cluster_unasked(points: Float[np.ndarray, "keys D"], seed: int) -> tuple[Clusters, tuple[Score, ...]]:
    """The grouping of the highest silhouette, one motion where none is convincing; and the cost left for each K.

    Two key-frames are two motions: nothing tells whether they are alike.
    """
    most = min(MOST_MOTIONS, distinct(points))
    points = compact(points)
    found = [cluster(points, k, seed) for k in range(1, most + 1)]
    whole = found[0].inertia or 1.0
    scores = tuple(Score(motions=k + 1, score=round(c.inertia / whole, 6)) for k, c in enumerate(found))
    if len(points) <= 2:
        return found[-1], scores
    judged = [_silhouette(points, c.labels, seed) for c in found if 1 < len(np.unique(c.labels)) < len(points)]
    best = int(np.argmax(judged)) if judged else 0
    return found[best + 1 if judged and judged[best] >= LEAST_SILHOUETTE else 0], scores


def _silhouette(points: Float[np.ndarray, "keys D"], labels: Int[np.ndarray, "keys"], seed: int) -> float:
    sample = SILHOUETTE_SAMPLE if len(points) > SILHOUETTE_SAMPLE else None
    with threadpool_limits(1):
        return float(silhouette_score(points, labels, sample_size=sample, random_state=seed))
