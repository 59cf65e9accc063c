"""Caesura as scikit-learn has it: estimators with `fit`, `labels_` and `get_params`, to be cloned, searched, piped.

Shapes are in the docstrings alone: scikit-learn's own checks of input stand in for ours, and say what its users know.
"""

from collections.abc import Mapping
from typing import Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from sklearn.base import BaseEstimator, ClusterMixin, TransformerMixin
from sklearn.utils.validation import _check_feature_names_in, check_is_fitted, validate_data

from caesura.api import open_animation
from caesura.core.animation import Animation
from caesura.core.block_pass.pose_basis import PoseBasis
from caesura.core.feature_sequence import segment_feature_sequence
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.file_sources import FileSources, is_file_source
from caesura.motion_recognition import MotionRecogniser, scale_to_unit

Motion: TypeAlias = Animation | FileSources | ArrayLike


class MotionSegmenter(ClusterMixin, BaseEstimator):  # type: ignore[misc]  # scikit-learn has no types
    """Labels the frames of one take by motion; rows are frames in order of time, so to shuffle them is to lose it.

        MotionSegmenter(motions=5, frame_rate=30).fit_predict(features)            # (frames, D)
        MotionSegmenter(motions="auto").fit(vertices, triangles=triangles).labels_  # (frames, V, 3) and (T, 3)

    The parameters are those of `core.Parameters`, by name, and `frame_rate` (frames per second, of arrays) and
    `threads`. After `fit`: `labels_` (frames,), integers from 0 in order of first appearance; `cuts_` (cuts,), the
    first frame of every segment but the first; `confidence_` (cuts,), 0 to 1; `segmentation_`, all of it, as
    `caesura.segment` returns it. With features also `n_features_in_`.
    """

    def __init__(
        self,
        motions: int | str = "auto",
        *,
        method: str = "switching",
        frame_rate: float = 30.0,
        expect: str = "auto",
        keyframe_window_seconds: float = 2.0,
        threshold: float = 0.1,
        details: bool = False,
        seed: int = 0,
        descriptor: str = "strain",
        descriptors: str = "auto",
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
        self.expect = expect
        self.keyframe_window_seconds = keyframe_window_seconds
        self.threshold = threshold
        self.details = details
        self.seed = seed
        self.descriptor = descriptor
        self.descriptors = descriptors
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
        """Find the motions of X: features (frames, D), vertices (frames, V, 3), an `Animation`, or a file.

        Raises ValueError for features that are no finite numbers, else what `caesura.segment` raises.
        """
        parameters = self._parameters()
        if _is_features(X, triangles):
            values = validate_data(self, X, dtype="numeric", ensure_min_samples=2)
            self._poses: PoseBasis | None = None
            found = segment_feature_sequence(values, parameters, frame_rate=float(self.frame_rate))
        else:
            animation = open_animation(X, triangles, frame_rate=self.frame_rate)
            analysis = analyse(animation, parameters, threads=self.threads)
            found = cut(analysis, parameters)
            self._poses = PoseBasis.learn(animation, parameters, analysis, threads=self.threads)
            values = self._poses.measured_in(analysis)
        self._recogniser = MotionRecogniser(self.window_seconds).fit(values, found.segments, found.frame_rate)
        self.segmentation_ = found
        self.labels_ = found.labels
        self.cuts_ = found.cuts
        self.confidence_ = found.confidence
        return self

    def predict(self, X: Motion, *, triangles: ArrayLike | None = None) -> np.ndarray:
        """Which of the fitted motions each frame of another take is: (frames,), in the numbers of `labels_`.

        The take is cut with the same parameters, and each of its segments is the motion whose windows are nearest. It
        holds the same features as the fitted one, or the same body; every motion of it is taken for a fitted one.

        Raises ValueError or `InvalidModel` where the two cannot be compared, else what `fit` raises.
        """
        check_is_fitted(self)
        if _is_features(X, triangles) != (self._poses is None):
            raise ValueError("Features are compared with features, and takes with takes: fit on what is predicted.")
        parameters = self._parameters()
        if self._poses is None:
            values = validate_data(self, X, dtype="numeric", ensure_min_samples=2, reset=False)
            found = segment_feature_sequence(values, parameters, frame_rate=float(self.frame_rate))
        else:
            animation = open_animation(X, triangles, frame_rate=self.frame_rate)
            values = self._poses.measure(animation, threads=self.threads)
            found = cut(analyse(animation, parameters, threads=self.threads), parameters)
        return self._recogniser.predict(values, found.segments, found.frame_rate)

    def _parameters(self) -> Parameters:
        chosen = {name: value for name, value in self.get_params().items() if name in Parameters.model_fields}
        return Parameters.parse(chosen)


class MotionFeatures(TransformerMixin, BaseEstimator):  # type: ignore[misc]  # scikit-learn has no types
    """The poses of a take as numbers, for clusterings of one's own: `make_pipeline(MotionFeatures(), KMeans(5))`.

    `fit` learns the leading components of a take, and `transform` measures that take, or another of the same body, on
    them. Of features (frames, D) it learns mean and scale alone, so that all columns together have unit mean square.
    """

    def __init__(
        self, descriptor: str = "strain", *, descriptors: str = "auto", frame_rate: float = 30.0, threads: int = 1
    ) -> None:
        self.descriptor = descriptor
        self.descriptors = descriptors
        self.frame_rate = frame_rate
        self.threads = threads

    def fit(self, X: Motion, y: object = None, *, triangles: ArrayLike | None = None) -> Self:  # noqa: ARG002  scikit-learn's y
        """Learn what the take is measured on; raises what `MotionSegmenter.fit` raises."""
        self._learn(X, triangles)
        return self

    def transform(self, X: Motion, *, triangles: ArrayLike | None = None) -> np.ndarray:
        """(frames, columns): the descriptors side by side, or the features; no column where nothing moves.

        Raises ValueError or `InvalidModel` (`wrong-shape`) where it is no take of what was fitted.
        """
        check_is_fitted(self)
        if _is_features(X, triangles) != (self._poses is None):
            raise ValueError("Features are compared with features, and takes with takes: fit on what is transformed.")
        if self._poses is None:
            values = validate_data(self, X, dtype=np.float64, reset=False)
            return np.asarray((values - self._centre) * self._scale)
        return self._poses.measure(open_animation(X, triangles, frame_rate=self.frame_rate), threads=self.threads)

    def fit_transform(self, X: Motion, y: object = None, *, triangles: ArrayLike | None = None) -> np.ndarray:  # noqa: ARG002  scikit-learn's y
        """What `fit` and `transform` give, in one pass over the take."""
        return self._learn(X, triangles)

    def get_feature_names_out(self, input_features: ArrayLike | None = None) -> np.ndarray:
        """The names of the columns: `strain0`, …, `pair_distances0`, …; of features their own."""
        check_is_fitted(self)
        if self._poses is None:
            return np.asarray(_check_feature_names_in(self, input_features), dtype=object)
        return np.array(self._poses.names, dtype=object)

    def _learn(self, X: Motion, triangles: ArrayLike | None) -> np.ndarray:
        if _is_features(X, triangles):
            values = validate_data(self, X, dtype=np.float64)
            self._poses: PoseBasis | None = None
            self._centre = values.mean(axis=0)
            self._scale = scale_to_unit(values)
            return np.asarray((values - self._centre) * self._scale)
        parameters = Parameters.parse({"descriptor": self.descriptor, "descriptors": self.descriptors})
        animation = open_animation(X, triangles, frame_rate=self.frame_rate)
        analysis = analyse(animation, parameters, threads=self.threads)
        self._poses = PoseBasis.learn(animation, parameters, analysis, threads=self.threads)
        return self._poses.measured_in(analysis)

    def __sklearn_is_fitted__(self) -> bool:
        return hasattr(self, "_poses")


def _is_features(X: Motion, triangles: ArrayLike | None) -> bool:
    """Whether scikit-learn should judge it: anything but a take, and arrays of vertices."""
    if triangles is not None or isinstance(X, Animation):
        return False
    if hasattr(X, "ndim"):  # a sparse matrix, which may be a mapping too
        return bool(X.ndim != 3)
    return not isinstance(X, Mapping) and not is_file_source(X) and np.asarray(X).ndim != 3
