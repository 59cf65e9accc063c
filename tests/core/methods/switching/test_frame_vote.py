"""The vote on frames: a cut goes where most labellings have it."""

import numpy as np

from caesura.core.methods.switching.frame_vote import vote_on_frames


def cut_at(*frames, motions=(0, 1, 0), length=60):
    """Labels of a take that is cut at these frames."""
    return np.repeat(motions, np.diff([0, *frames, length]))


def test_a_cut_goes_where_most_have_it():
    """Of three the one in the middle, whatever the others call the motions."""
    others = cut_at(20, 40), cut_at(24, 44, motions=(5, 2, 5)), cut_at(26, 46, motions=(1, 0, 1))
    assert vote_on_frames(others[0], others).tolist() == cut_at(24, 44).tolist()


def test_a_draw_leaves_the_cut_where_it_is():
    """Two against two: the labelling with which the others agree most decides."""
    early, late = cut_at(20, 40), cut_at(26, 46)
    for own in (early, late):
        assert vote_on_frames(own, (early, early, late, late)).tolist() == own.tolist()


def test_a_vote_neither_adds_nor_loses_a_segment():
    """Others that see one segment more, each its own or all the same, are not heard."""
    own, more = cut_at(20, 40), cut_at(20, 30, 36, 40, motions=(0, 1, 0, 1, 0))
    assert vote_on_frames(own, (own, more, more)).tolist() == own.tolist()
    assert vote_on_frames(more, (own, own, more)).tolist() == more.tolist()
