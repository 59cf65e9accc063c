"""Segments of least dissimilarity within, against every segmentation there is."""

import numpy as np
import pytest

from caesura.core.methods.luo2014.partition import partition_frames
from caesura.core.methods.luo2014.segment_grouping import group_segments
from tests import oracles


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("segments", "shortest"), [(1, 1), (2, 2), (3, 3), (4, 1)])
def test_no_segmentation_has_less_within(seed, segments, shortest):
    """Twelve frames, every way to cut them."""
    values = np.random.default_rng(seed).normal(size=(12, 3)).cumsum(axis=0)
    bounds = partition_frames(values, segments, shortest)
    assert len(bounds) == segments + 1
    assert np.diff(bounds).min() >= shortest
    found = oracles.dissimilarity(values, bounds)
    assert found == pytest.approx(oracles.least_dissimilarity(values, segments, shortest), abs=1e-12)


def test_segments_are_shorter_where_there_is_no_room():
    """Five frames, three segments of two asked for; and more segments than frames."""
    values = np.arange(5.0)[:, None]
    assert len(partition_frames(values, 3, 2)) == 4
    assert partition_frames(values, 9, 1).tolist() == [0, 1, 2, 3, 4, 5]


def test_segments_that_are_alike_are_one_motion():
    """a b a c b, each about its own place."""
    random = np.random.default_rng(2)
    places = np.array([[0.0, 0], [9, 0], [0, 9]])[[0, 1, 0, 2, 1]]
    values = np.repeat(places, 6, axis=0) + random.normal(size=(30, 2))
    a, b, c, d, e = group_segments(values, np.arange(0, 31, 6), 3).tolist()
    assert a == c
    assert b == e
    assert len({a, b, d}) == 3
