"""Refinement: a cut found through windows goes to the frame where the motion changes."""

import numpy as np
import pytest

from core.analysis import Features
from core.refinement import refined

RATE = 30.0


def two_motions(cut=150, frames=300):
    """Two swings about two poses, changing at a frame."""
    time = np.arange(frames) / RATE
    first = np.stack([np.sin(5 * time), np.cos(5 * time), 0 * time], 1)
    second = np.stack([0 * time, np.sin(9 * time), 1.5 + np.cos(9 * time)], 1)
    return (Features("pair-distances", np.where(time[:, None] < cut / RATE, first, second).astype(np.float32), 1.0),)


@pytest.mark.parametrize("guess", [137, 140, 150, 163])
def test_a_cut_goes_to_the_change(guess):
    """From up to 13 frames off, to within one frame."""
    labels = (np.arange(300) >= guess).astype(np.int64)
    assert abs(np.flatnonzero(np.diff(refined(labels, two_motions(), RATE)))[0] + 1 - 150) <= 1


def test_a_cut_moves_at_most_a_second():
    """Guessed two seconds off, it goes as far as it may and no farther."""
    labels = (np.arange(300) >= 90).astype(np.int64)
    assert np.flatnonzero(np.diff(refined(labels, two_motions(), RATE)))[0] + 1 <= 120


def test_no_segment_is_lost():
    """Cuts a few frames apart all stay, in order."""
    labels = np.repeat([0, 1, 0, 1], [147, 3, 3, 147])
    moved = refined(labels, two_motions(), RATE)
    assert moved[np.flatnonzero(np.diff(moved, prepend=-1))].tolist() == [0, 1, 0, 1]


def test_nothing_to_move_by():
    """Without features, and without cuts, the labels stay as they are."""
    labels = np.repeat([0, 1], [10, 10])
    assert refined(labels, (), RATE) is labels
    assert refined(labels * 0, two_motions(frames=20), RATE).tolist() == [0] * 20
