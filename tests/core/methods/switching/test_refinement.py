"""Refinement: a cut found through windows goes to the frame where the motion changes."""

import numpy as np
import pytest

from caesura.core.analysis import Features
from caesura.core.methods.switching.refinement import refine_cuts

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
    assert abs(np.flatnonzero(np.diff(refine_cuts(labels, two_motions(), RATE).labels))[0] + 1 - 150) <= 1


def test_a_cut_moves_at_most_a_second():
    """Guessed two seconds off, it goes as far as it may and no farther."""
    labels = (np.arange(300) >= 90).astype(np.int64)
    assert np.flatnonzero(np.diff(refine_cuts(labels, two_motions(), RATE).labels))[0] + 1 <= 120


def test_no_segment_is_lost():
    """Cuts a few frames apart all stay, in order."""
    labels = np.repeat([0, 1, 0, 1], [147, 3, 3, 147])
    moved = refine_cuts(labels, two_motions(), RATE).labels
    assert moved[np.flatnonzero(np.diff(moved, prepend=-1))].tolist() == [0, 1, 0, 1]


def test_nothing_to_move_by():
    """Without features, and without cuts, the labels stay as they are."""
    labels = np.repeat([0, 1], [10, 10])
    assert refine_cuts(labels, (), RATE).labels is labels
    assert refine_cuts(labels * 0, two_motions(frames=20), RATE).labels.tolist() == [0] * 20


def test_a_cut_between_unlike_motions_is_clear():
    """Each side is like its own motion alone: moving the cut would cost as much as there is."""
    (found,) = refine_cuts((np.arange(300) >= 150).astype(np.int64), two_motions(), RATE).clearness
    assert found > 0.9


def test_a_gradual_change_is_less_clear_than_a_sudden_one():
    """Where one motion turns into the other over two seconds, the frames beside the cut are like neither."""
    labels = (np.arange(300) >= 150).astype(np.int64)
    (sudden,) = two_motions()
    (first,), (second,) = two_motions(cut=300), two_motions(cut=0)
    share = np.clip((np.arange(300) - 120) / 60, 0, 1)[:, None]
    gradual = Features("pair-distances", (first.values * (1 - share) + second.values * share).astype(np.float32), 1.0)
    assert refine_cuts(labels, (gradual,), RATE).clearness[0] < refine_cuts(labels, (sudden,), RATE).clearness[0] - 0.2


def test_a_cut_within_one_motion_is_not_clear():
    """Frames on either side are as like the motion after it as the one before."""
    (found,) = refine_cuts((np.arange(300) >= 150).astype(np.int64), two_motions(cut=300), RATE).clearness
    assert found < 0.5
