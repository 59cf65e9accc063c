"""The estimators keep scikit-learn's conventions, as far as these make sense for rows in order of time."""

import inspect

import numpy as np
import pytest
from sklearn.base import clone
from sklearn.cluster import KMeans
from sklearn.metrics import adjusted_rand_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.utils.estimator_checks import parametrize_with_checks

from caesura import MotionFeatures, MotionSegmenter, segment
from caesura.api import READING
from caesura.core.parameters import Parameters
from tests.animations import performing_bar

ORDER_IS_TIME = "rows are frames in order: shuffled blobs, or rows taken apart, are another take"


def not_applicable(_):
    """Checks of scikit-learn that ask for what a segmentation in time is not."""
    return {
        "check_clustering": ORDER_IS_TIME,
    }


@parametrize_with_checks([MotionSegmenter(motions=2)], expected_failed_checks=not_applicable)
def test_it_passes_scikit_learns_own_checks(estimator, check):
    """Cloning, parameters, input that is refused, repeated fits, pickling: forty promises of an estimator."""
    check(estimator)


@pytest.fixture(scope="module")
def bar():
    """Two motions in four segments, 720 frames."""
    return performing_bar((0, 1, 0, 1), rings=16)


def test_its_parameters_are_those_of_the_method():
    """Each has the name and the default of `core.Parameters`; those that read a file are left out."""
    signature = inspect.signature(MotionSegmenter).parameters
    ours = {name: parameter.default for name, parameter in signature.items() if name not in ("frame_rate", "threads")}
    theirs = {name: field.default for name, field in Parameters.model_fields.items() if name not in READING}
    assert ours == theirs


def test_an_animation_is_fitted_as_core_segments_it(bar):
    """Labels, cuts and the whole result; a clone is unfitted and does the same."""
    segmenter = MotionSegmenter(motions=2)
    labels = segmenter.fit_predict(bar.animation)
    assert np.array_equal(labels, segment(bar.animation, motions=2).labels)
    assert len(segmenter.cuts_) == len(segmenter.confidence_) == 3
    assert segmenter.segmentation_.motions == 2
    again = clone(segmenter).set_params(method="joint-entropy")
    assert not hasattr(again, "labels_")
    assert again.fit(bar.animation).segmentation_.method == "joint-entropy"


def test_vertices_are_fitted_with_their_triangles(bar):
    """(frames, V, 3) with (T, 3)."""
    vertices = np.array(bar.animation.vertices(0, bar.animation.frames))
    labels = MotionSegmenter(motions=2).fit_predict(vertices, triangles=bar.animation.triangles)
    assert adjusted_rand_score(bar.truth, labels) > 0.9


def test_it_goes_into_a_pipeline(bar):
    """Behind a scaler, as any clustering."""
    vertices = np.array(bar.animation.vertices(0, bar.animation.frames))
    features = vertices[:, ::8].reshape(len(vertices), -1)
    pipeline = make_pipeline(StandardScaler(), MotionSegmenter(motions=2))
    assert adjusted_rand_score(bar.truth, pipeline.fit_predict(features)) > 0.9


def test_features_serve_other_clusterings(bar):
    """Poses as numbers for each frame, for k-means or anything else."""
    features = MotionFeatures().fit_transform(bar.animation)
    assert features.shape[0] == bar.animation.frames
    labels = make_pipeline(clone(MotionFeatures()), KMeans(2, n_init=3, random_state=0)).fit_predict(bar.animation)
    assert labels.shape == (bar.animation.frames,)
