"""Consensus: the labelling with which the others agree most."""

import numpy as np

from caesura.core.methods.switching.consensus import find_consensus

TRUE = np.repeat([0, 1, 2, 0], 10)


def shifted(by):
    """The true labels, every cut later."""
    return np.roll(TRUE, by)


def test_the_one_in_the_middle_is_taken():
    """Of three that differ by shifts it is the middle one, wherever it stands."""
    assert find_consensus([shifted(-2), TRUE, shifted(2)]) == 1
    assert find_consensus([TRUE, shifted(-2), shifted(2)]) == 0


def test_one_that_errs_alone_is_not_taken():
    """Even if it comes first; names of motions do not matter."""
    astray = np.repeat([0, 1, 2, 2], 10)
    assert find_consensus([astray, TRUE, 2 - TRUE]) == 1


def test_equals_are_decided_by_order_and_one_alone_is_taken():
    """Whatever it is."""
    assert find_consensus([TRUE, TRUE, TRUE]) == 0
    assert find_consensus([np.zeros(4, np.int64)]) == 0


def test_fewer_motions_than_others_found_do_not_vote():
    """Two that join two motions do not outvote one that tells them apart."""
    joined = np.where(TRUE == 2, 1, TRUE)
    assert find_consensus([joined, joined, TRUE]) == 2
