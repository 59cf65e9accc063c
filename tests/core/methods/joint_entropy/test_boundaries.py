"""Boundaries between key-frames of different motions (Eq. 5)."""

import numpy as np

from caesura.core.methods.joint_entropy.boundaries import find_boundary, label_frames_between_keys
from tests import oracles


def test_the_boundary_is_the_one_that_variances_choose():
    """By prefix sums as by np.var, on curves of any shape and offset."""
    draw = np.random.default_rng(5)
    for length in (3, 4, 10, 60):
        for offset in (0.0, 100.0):
            curve = offset + np.cumsum(draw.normal(size=length + 4))
            assert find_boundary(curve, 2, length) == oracles.boundary(curve, 2, length)


def test_between_two_levels_the_boundary_is_the_step():
    """Both sides are then constant but for the one frame they share."""
    curve = np.array([1, 1, 1, 1, 3, 3, 3, 3.0])
    assert find_boundary(curve, 0, 7) in (3, 4)


def test_neighbouring_key_frames_are_cut_between_them():
    """b = a + 1: the boundary is b."""
    assert find_boundary(np.array([1.0, 2.0]), 0, 1) == 1


def test_every_frame_has_the_motion_of_its_key_frame():
    """Labels change only between key-frames of different motions, and reach both ends."""
    curve = np.array([1, 2, 1, 2, 1, 5, 6, 5.0])
    labels = label_frames_between_keys(curve, np.array([1, 3, 6]), np.array([4, 4, 2]))
    assert labels[[0, 1, 2, 3]].tolist() == [4, 4, 4, 4]
    assert labels[[6, 7]].tolist() == [2, 2]
    assert np.count_nonzero(np.diff(labels)) == 1
