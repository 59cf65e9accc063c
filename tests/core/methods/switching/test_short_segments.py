"""Blur: a segment shorter than a window is no motion, unless it is the only one of its kind."""

import numpy as np
import pytest

from caesura.core.methods.switching.short_segments import remove_short_segments
from caesura.core.methods.switching.switching_k_means import SwitchingClusters
from caesura.core.methods.switching.windowed_signal import WindowedSignal

MEANS = np.array([[0.0], [2.0], [1.0]])


def signal(values):
    rows = np.array(values, float)[:, None]
    return WindowedSignal(rows, rows * 0, rows * 0, 3, 3 * len(rows), 0.1)


@pytest.mark.parametrize("length", [1, 8, 14])
def test_what_a_window_saw_between_two_motions_is_divided(length):
    """A ramp from 0 to 2 passes by 1, the mean of a third motion: the cut goes to the middle of the ramp."""
    ramp = np.linspace(0, 2, length + 2)[1:-1]
    values = [*[0.0] * 30, *ramp, *[2.0] * 30, *[1.0] * 30]
    labels = np.repeat([0, 2, 1, 2], [30, length, 30, 30])
    cleared = remove_short_segments(signal(values), SwitchingClusters(labels, MEANS, 0.0)).labels
    assert np.flatnonzero(np.diff(cleared)).tolist() == [pytest.approx(29 + length / 2, abs=1), 59 + length]
    assert cleared[[0, 40 + length, -1]].tolist() == [0, 1, 2]


def test_a_break_in_one_motion_is_closed():
    """The same motion before and after: the segment between joins them."""
    labels = np.repeat([0, 2, 0, 2], [30, 5, 30, 30])
    assert np.flatnonzero(
        np.diff(remove_short_segments(signal([0.0] * 95), SwitchingClusters(labels, MEANS, 0.0)).labels)
    ) == [64]


@pytest.mark.parametrize(("motions", "lengths"), [((0, 1, 0), (30, 5, 30)), ((0, 1, 0, 1), (5, 30, 30, 5))])
def test_the_only_one_of_its_kind_and_the_ends_stay(motions, lengths):
    """A short motion that comes once is a motion; at the ends of a take segments are cut short."""
    labels = np.repeat(motions, lengths)
    np.testing.assert_array_equal(
        remove_short_segments(signal([0.0] * len(labels)), SwitchingClusters(labels, MEANS, 0.0)).labels, labels
    )


def test_long_segments_stay():
    """A segment as long as a window is none of this."""
    labels = np.repeat([0, 2, 1, 2], [30, 15, 30, 30])
    np.testing.assert_array_equal(
        remove_short_segments(signal([0.0] * 105), SwitchingClusters(labels, MEANS, 0.0)).labels, labels
    )
