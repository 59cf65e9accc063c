"""Caesura as scikit-learn has it: estimators with `fit`, `labels_` and `get_params`, to be cloned, searched, piped.

Shapes are in the docstrings alone: scikit-learn's own checks of input stand in for ours, and say what its users know.
"""

from collections.abc import Mapping
from mmap import mmap
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from sklearn.base import BaseEstimator, ClusterMixin, TransformerMixin
from sklearn.utils.validation import validate_data

from caesura.api import Bytes, open_animation, segment
from caesura.core.animation import Animation
from caesura.core.methods.pose_features import pose_features
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse

Motion = Animation | Bytes | Mapping[str, Bytes] | ArrayLike


class MotionSegmenter(ClusterMixin, BaseEstimator):  # type: ignore[misc]  # scikit-learn has no types
    """Labels the frames of one take by motion; rows are frames in order of time, so to shuffle them is to lose it.

        MotionSegmenter(motions=5, frame_rate=30).fit_predict(features)            # (frames, D)
        MotionSegmenter(motions="auto").fit(vertices, triangles=triangles).labels_  # (frames, V, 3) and (T, 3)

    The parameters are those of `core.Parameters`, by name, and `frame_rate` (frames per second, of arrays) and
    `threads`. After `fit`: `labels_` (frames,), integers from 0 in order of first appearance; `cuts_` (cuts,), the
    first frame of every segment but the first; `confidence_` (cuts,), 0 to 1; `segmentation_`, all of it, as
    `core.segment` returns it. With features also `n_features_in_`.
    """

    def __init__(
        self,
        motions: int | str = "auto",
        *,
        method: str = "switching",
        frame_rate: float = 30.0,
        keyframe_window_seconds: float = 2.0,
        threshold: float = 0.1,
        seed: int = 0,
        descriptor: str = "strain",
        strain: str = "log",
        curvature: str = "gaussian",
        rest: str | int = "bind",
        scale_invariant: bool = False,
        normalize: str | float = "p99.9",
        bins: int = 10,
        energy: str = "modified",
        window_seconds: float = 1.3,
        threads: int = 1,
    ) -> None:
        self.motions = motions
        self.method = method
        self.frame_rate = frame_rate
        self.keyframe_window_seconds = keyframe_window_seconds
        self.threshold = threshold
        self.seed = seed
        self.descriptor = descriptor
        self.strain = strain
        self.curvature = curvature
        self.rest = rest
        self.scale_invariant = scale_invariant
        self.normalize = normalize
        self.bins = bins
        self.energy = energy
        self.window_seconds = window_seconds
        self.threads = threads

    def fit(self, X: Motion, y: object = None, *, triangles: ArrayLike | None = None) -> Self:  # noqa: ARG002  scikit-learn's y
        """Find the motions of X: features (frames, D), vertices (frames, V, 3), an `Animation`, or a file's bytes.

        Raises ValueError for features that are no finite numbers, else what `core.segment` raises.
        """
        if _is_features(X, triangles):
            X = validate_data(self, X, dtype="numeric", ensure_min_samples=2)
        chosen = {name: value for name, value in self.get_params().items() if name in Parameters.model_fields}
        found = segment(X, triangles, frame_rate=self.frame_rate, threads=self.threads, **chosen)
        self.segmentation_ = found
        self.labels_ = found.labels
        self.cuts_ = found.cuts
        self.confidence_ = found.confidence
        return self


class MotionFeatures(TransformerMixin, BaseEstimator):  # type: ignore[misc]  # scikit-learn has no types
    """The poses of a take as numbers, for clusterings of one's own: `make_pipeline(MotionFeatures(), KMeans(5))`.

    Every take is described on its own leading components, so nothing is learnt by `fit`, and columns of two takes
    are not the same measurements.
    """

    def __init__(self, descriptor: str = "strain", *, frame_rate: float = 30.0, threads: int = 1) -> None:
        self.descriptor = descriptor
        self.frame_rate = frame_rate
        self.threads = threads

    def fit(self, X: Motion, y: object = None) -> Self:  # noqa: ARG002  there is nothing to learn
        """Nothing."""
        return self

    def transform(self, X: Motion, *, triangles: ArrayLike | None = None) -> np.ndarray:
        """(frames, D): strain and pair distances side by side, each at unit mean square about its mean."""
        animation = open_animation(X, triangles, frame_rate=self.frame_rate)
        parameters = Parameters.parse({"descriptor": self.descriptor})
        return pose_features(analyse(animation, parameters, threads=self.threads).features)

    def __sklearn_is_fitted__(self) -> bool:
        return True


def _is_features(X: Motion, triangles: ArrayLike | None) -> bool:
    """Whether scikit-learn should judge it: anything but a take, and arrays of vertices."""
    if triangles is not None or isinstance(X, Animation | bytes | bytearray | memoryview | mmap):
        return False
    if hasattr(X, "ndim"):  # a sparse matrix, which may be a mapping too
        return bool(X.ndim != 3)
    return not isinstance(X, Mapping) and np.ndim(X) != 3
