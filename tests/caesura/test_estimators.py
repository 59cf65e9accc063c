"""The estimators keep scikit-learn's conventions, as far as these make sense for rows in order of time."""

import inspect
import pickle

import numpy as np
import pytest
from sklearn.base import clone
from sklearn.cluster import KMeans
from sklearn.metrics import adjusted_rand_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.utils.estimator_checks import parametrize_with_checks

from caesura import MotionFeatures, MotionSegmenter, segment
from caesura.api import READING_PARAMETERS
from caesura.core.errors import InvalidModel
from caesura.core.parameters import Parameters
from tests.animations import performing_bar
from tests.conftest import installed
from tests.installation import take_npz

ORDER_IS_TIME = "rows are frames in order: shuffled blobs, or rows taken apart, are another take"
REFUSED = {
    "check_clustering": ORDER_IS_TIME,
    "check_methods_subset_invariance": ORDER_IS_TIME,
}
"""Checks of scikit-learn that ask for what a segmentation in time is not."""


@parametrize_with_checks(
    [MotionSegmenter(motions=2), MotionFeatures()],
    expected_failed_checks=lambda estimator: REFUSED if isinstance(estimator, MotionSegmenter) else {},
)
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
    theirs = {name: field.default for name, field in Parameters.model_fields.items() if name not in READING_PARAMETERS}
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


def columns(bar):
    """What a program might have measured: some coordinates of every frame."""
    vertices = np.array(bar.animation.vertices(0, bar.animation.frames))
    return vertices[:, ::8].reshape(len(vertices), -1)


@pytest.fixture(scope="module")
def other():
    """The same two motions in another order, in a take of its own."""
    return performing_bar((1, 0), rings=16)


@pytest.mark.parametrize("given", [columns, lambda bar: bar.animation], ids=["features", "take"])
def test_a_new_take_has_the_motions_of_the_fitted_one(bar, other, given):
    """Motion 0 of the fitted take is 0 in the new one too, where it comes second; of the fitted take, its labels."""
    segmenter = MotionSegmenter(motions=2).fit(given(bar))
    assert (segmenter.labels_ == bar.truth).mean() > 0.95
    assert np.array_equal(segmenter.predict(given(bar)), segmenter.labels_)
    assert (segmenter.predict(given(other)) == other.truth).mean() > 0.95
    travelled = pickle.loads(pickle.dumps(segmenter))
    assert np.array_equal(travelled.predict(given(other)), segmenter.predict(given(other)))


def test_one_motion_of_several_is_recognised(bar):
    """A take of one of them is that one, though it is cut into as many as were asked for."""
    segmenter = MotionSegmenter(motions=2).fit(bar.animation)
    assert (segmenter.predict(performing_bar((1,), rings=16).animation) == 1).mean() > 0.95


def test_a_take_in_which_nothing_moves_is_one_motion():
    """There is nothing to tell motions apart by, in the fitted take or in another."""
    still = np.zeros((90, 3))
    assert MotionSegmenter().fit(still).predict(still).tolist() == [0] * 90


@pytest.mark.parametrize("estimator", [MotionSegmenter(motions=2), MotionFeatures()], ids=["segmenter", "features"])
def test_what_cannot_be_compared_is_refused(bar, estimator):
    """Features with a take, and a take with one of another body."""
    ask = "predict" if hasattr(estimator, "predict") else "transform"
    with pytest.raises(ValueError, match="takes with takes"):
        getattr(clone(estimator).fit(columns(bar)), ask)(bar.animation)
    with pytest.raises(InvalidModel, match="Takes of one body"):
        getattr(clone(estimator).fit(bar.animation), ask)(performing_bar((0, 1), rings=12).animation)


def test_columns_of_two_takes_are_the_same_measurements(bar, other):
    """Frames that are alike are alike in both, and the names say how many columns there are."""
    features = MotionFeatures()
    first = features.fit_transform(bar.animation)
    assert np.allclose(features.transform(bar.animation), first, atol=1e-5)
    second = features.transform(other.animation)
    assert first.shape[1] == second.shape[1] == len(features.get_feature_names_out())
    assert {name.rstrip("0123456789") for name in features.get_feature_names_out()} == {"strain", "pair_distances"}
    apart = np.linalg.norm(first[60] - second[60 + 180], axis=0)  # motion 0, a third of its way, in either
    assert apart < 0.2 * np.linalg.norm(first[60] - second[60])


def test_features_of_ones_own_keep_their_names(bar):
    """(frames, D) come out as many columns, together at unit mean square."""
    pandas = installed("pandas")
    frame = pandas.DataFrame(columns(bar)[:, :4], columns=["a", "b", "c", "d"])
    features = MotionFeatures().fit(frame)
    assert features.get_feature_names_out().tolist() == ["a", "b", "c", "d"]
    assert np.square(features.transform(frame)).sum() / len(frame) == pytest.approx(1)


@pytest.mark.parametrize("suffix", ["str", "open"])
def test_a_file_is_fitted(bar, tmp_path, suffix):
    """By its path or opened, as `segment` takes it."""
    path = tmp_path / "take.npz"
    path.write_bytes(take_npz())
    with path.open("rb") as file:
        labels = MotionSegmenter(motions=2).fit_predict(str(path) if suffix == "str" else file)
    assert np.array_equal(labels, segment(path, motions=2).labels)
