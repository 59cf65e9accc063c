"""Key-frames into motions (paper, section 4.1): K-means on their strain, K given or chosen."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from sklearn.cluster import KMeans
from sklearn.metrics import silhouette_score

from caesura.core.document import Score
from caesura.core.single_threaded_blas import single_threaded_blas

STARTS = 20
MOST_MOTIONS = 20
LEAST_SILHOUETTE = 0.25
"""Below this a grouping is "no substantial structure" (Kaufman and Rousseeuw, 1990): then all is one motion."""

SAMPLE = 400
"""Of more key-frames than these, a quarter of an hour's, so many evenly chosen ones say how many groups there are and
where they begin: starts and silhouettes would otherwise take minutes on an hour of motion."""


@dataclass(frozen=True)
class KeyFrameClusters:
    """`labels` (keys,), and for each key how clearly it belongs there: 1 − (own centre's distance / next centre's)."""

    labels: Int[np.ndarray, "keys"]
    margin: Float[np.ndarray, "keys"]
    inertia: float


def cluster_key_frames(points: Float[np.ndarray, "keys D"], motions: int, seed: int) -> KeyFrameClusters:
    """K-means with 20 starts and a fixed seed, on one thread: the same labels for any number of threads.

    Above `SAMPLE` points the starts are tried on a sample, and all points go on from the best of them.
    """
    with single_threaded_blas():
        few = sample_key_frames(points)
        seen = reduce_dimensions(few)
        fit = KMeans(min(motions, count_distinct(few)), n_init=STARTS, random_state=seed).fit(seen)
        if len(few) < len(points):
            centres = np.stack([few[fit.labels_ == k].mean(axis=0) for k in np.unique(fit.labels_)])
            seen, fit = points, KMeans(len(centres), init=centres, n_init=1, random_state=seed).fit(points)
        distance = np.sort(fit.transform(seen), axis=1)
    margin = np.ones(len(points))
    if distance.shape[1] > 1:
        margin = 1 - distance[:, 0] / np.maximum(distance[:, 1], np.finfo(np.float32).tiny)
    return KeyFrameClusters(fit.labels_.astype(np.int64), margin.astype(np.float64), float(fit.inertia_))


def sample_key_frames(points: Float[np.ndarray, "keys D"]) -> Float[np.ndarray, "few D"]:
    """At most `SAMPLE` of the points, evenly spread over the take; all where there are no more."""
    if len(points) <= SAMPLE:
        return points
    return points[np.linspace(0, len(points) - 1, SAMPLE).astype(np.int64)]


def reduce_dimensions(points: Float[np.ndarray, "keys D"]) -> Float[np.ndarray, "keys d"]:
    """The same points in as few dimensions as they span: distances, which are all that K-means sees, stay.

    By the eigenvectors of the Gram matrix of the centred points, where they are fewer than their dimensions.
    """
    if not 1 < len(points) < points.shape[1]:
        return points
    centred = points - points.mean(axis=0, dtype=np.float64)
    with single_threaded_blas():
        squared, directions = np.linalg.eigh(centred @ centred.T)
    spanned = squared > squared[-1] * np.finfo(np.float64).eps
    return np.asarray(directions[:, spanned] * np.sqrt(squared[spanned]))


def count_distinct(points: Float[np.ndarray, "keys D"]) -> int:
    """How many different points there are: no more clusters than that."""
    return len(np.unique(points, axis=0))


def cluster_with_chosen_count(
    points: Float[np.ndarray, "keys D"], seed: int
) -> tuple[KeyFrameClusters, tuple[Score, ...]]:
    """The grouping of the highest silhouette, one motion where none is convincing; and the cost left for each K.

    Two key-frames are two motions: nothing tells whether they are alike. Above `SAMPLE` points a sample chooses K.
    """
    few = sample_key_frames(points)
    most = min(MOST_MOTIONS, count_distinct(few))
    few = reduce_dimensions(few)
    found = [cluster_key_frames(few, k, seed) for k in range(1, most + 1)]
    whole = found[0].inertia or 1.0
    scores = tuple(Score(motions=k + 1, score=round(c.inertia / whole, 6)) for k, c in enumerate(found))
    chosen = _choose_count(few, found)
    return (cluster_key_frames(points, chosen + 1, seed) if len(few) < len(points) else found[chosen]), scores


def _choose_count(points: Float[np.ndarray, "keys D"], found: list[KeyFrameClusters]) -> int:
    """Which of the groupings into 1, 2, … is taken."""
    if len(points) <= 2:
        return len(found) - 1
    judged = [_silhouette(points, c.labels) for c in found if 1 < len(np.unique(c.labels)) < len(points)]
    best = int(np.argmax(judged)) if judged else 0
    return best + 1 if judged and judged[best] >= LEAST_SILHOUETTE else 0


def _silhouette(points: Float[np.ndarray, "keys D"], labels: Int[np.ndarray, "keys"]) -> float:
    with single_threaded_blas():
        return float(silhouette_score(points, labels))
