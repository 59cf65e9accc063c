"""Key-frames into motions."""

import itertools
from time import perf_counter

import numpy as np
import pytest

from caesura.core.methods.joint_entropy.clustering import (
    SAMPLE,
    cluster_key_frames,
    cluster_with_chosen_count,
    count_distinct,
    reduce_dimensions,
)


def clouds(centres, each=8, spread=0.05):
    """Points about some centres on a line in 30 dimensions, and the centre of each."""
    draw = np.random.default_rng(6)
    truth = np.repeat(np.arange(len(centres)), each)
    return (np.outer(np.asarray(centres)[truth], np.ones(30)) + spread * draw.normal(size=(len(truth), 30))), truth


def same_grouping(a, b):
    """Whether two labellings differ in names alone."""
    return len(set(zip(a.tolist(), b.tolist(), strict=True))) == len(set(a.tolist())) == len(set(b.tolist()))


def test_clouds_are_found():
    """With K given, and the same labels every time."""
    points, truth = clouds([0, 1, 2.5])
    assert same_grouping(cluster_key_frames(points, 3, 0).labels, truth)
    np.testing.assert_array_equal(cluster_key_frames(points, 3, 0).labels, cluster_key_frames(points, 3, 0).labels)


@pytest.mark.parametrize("centres", [[0, 1], [0, 1, 2.5], [0, 1, 2.5, 4, 6]])
def test_k_unasked_is_the_number_of_clouds(centres):
    """And the cost left is told for every K tried, 1 for one motion."""
    points, truth = clouds(centres)
    found, scores = cluster_with_chosen_count(points, 0)
    assert same_grouping(found.labels, truth)
    assert (scores[0].motions, scores[0].score) == (1, 1.0)
    assert all(a.score >= b.score for a, b in itertools.pairwise(scores))


def test_points_without_structure_are_one_motion():
    """No grouping of a single cloud is convincing."""
    points, _ = clouds([0], each=40, spread=1.0)
    assert set(cluster_with_chosen_count(points, 0)[0].labels.tolist()) == {0}


def test_few_points():
    """One is one motion, two are two, and equal ones are one."""
    points, _ = clouds([0, 3], each=1)
    assert cluster_with_chosen_count(points[:1], 0)[0].labels.tolist() == [0]
    assert len(set(cluster_with_chosen_count(points, 0)[0].labels.tolist())) == 2
    assert set(cluster_with_chosen_count(points[[0, 0, 0]], 0)[0].labels.tolist()) == {0}
    assert count_distinct(points[[0, 0, 1]]) == 2


def test_a_point_between_two_centres_belongs_to_neither_clearly():
    """Its margin is near 0, that of a point at a centre near 1."""
    points, _ = clouds([0, 1, 0.5], each=6, spread=0.001)
    margin = cluster_key_frames(np.concatenate([points[:12], points[12:13]]), 2, 0).margin
    assert margin[:12].min() > 0.8
    assert margin[12] < 0.3


def test_points_in_fewer_dimensions_are_as_far_apart():
    """Compacting is an isometry, for points that are all equal too."""
    points, _ = clouds([0, 1, 2.5])
    few = reduce_dimensions(points)
    assert few.shape[1] < points.shape[0] <= points.shape[1]
    np.testing.assert_allclose(gaps(few), gaps(points), atol=1e-6)
    assert gaps(reduce_dimensions(np.ones((4, 9)))).max() == 0


def gaps(points):
    """All distances."""
    return np.linalg.norm(points[:, None] - points[None, :], axis=2)


@pytest.mark.parametrize("each", [SAMPLE // 2, SAMPLE])
def test_more_points_than_are_sampled_are_grouped_alike(each):
    """Each of many points has the group of its cloud, with K given and unasked."""
    points, truth = clouds([0, 1, 2.5], each=each)
    assert len(points) > SAMPLE
    assert same_grouping(cluster_key_frames(points, 3, 0).labels, truth)
    assert same_grouping(cluster_with_chosen_count(points, 0)[0].labels, truth)


def test_an_hour_of_key_frames_takes_seconds():
    """Two thousand of them, without structure, where K-means is slowest."""
    points = np.random.default_rng(0).normal(size=(2000, 2000))
    start = perf_counter()
    cluster_with_chosen_count(points, 0)
    assert perf_counter() - start < 20
