"""Transitions: what never lasts a second goes to its neighbours, and is told."""

import numpy as np

from caesura.core.methods.switching.transitions import remove_transitions


def test_half_a_second_between_two_motions_is_divided():
    """It comes twice and is no motion either time."""
    labels = np.repeat([0, 2, 1, 2, 0], [90, 16, 90, 14, 90])
    found = remove_transitions(labels, 30.0)
    np.testing.assert_array_equal(found.labels, np.repeat([0, 1, 0], [98, 105, 97]))
    assert found.transitions == ((90, 106), (196, 210))


def test_a_motion_that_lasts_once_keeps_its_short_runs():
    """More than a second in one of its runs is enough."""
    labels = np.repeat([0, 2, 1, 2], [90, 16, 90, 40])
    assert remove_transitions(labels, 30.0).labels is not labels
    np.testing.assert_array_equal(remove_transitions(labels, 30.0).labels, labels)


def test_at_the_ends_there_is_one_neighbour():
    """The first and the last frames go to the motion beside them."""
    labels = np.repeat([2, 0, 1, 2], [10, 90, 90, 10])
    np.testing.assert_array_equal(remove_transitions(labels, 30.0).labels, np.repeat([0, 1], 100))


def test_the_last_motion_stays():
    """A take of less than a second is one motion."""
    assert remove_transitions(np.repeat([0, 1], 5), 30.0).labels.tolist() == [1] * 10
