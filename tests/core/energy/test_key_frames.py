"""Key-frames: peaks of the energy curve."""

import numpy as np

from caesura.core.energy.key_frames import extract_key_frames, find_local_maxima
from tests import oracles


def keys(curve, window, threshold=0.0):
    """Key-frames of a curve given as a list."""
    curve = np.asarray(curve, float)
    return extract_key_frames(curve, find_local_maxima(curve), window, threshold).tolist()


def bump(frames=80, centre=40, width=6.0):
    """One smooth bump."""
    return np.exp(-(((np.arange(frames) - centre) / width) ** 2))


def test_one_bump_is_one_key_frame():
    """Its top, and nothing on its falling side."""
    assert keys(bump(), 12) == [40]


def test_algorithm_1_as_printed_appends_the_falling_side():
    """The erratum: as printed, the same bump gives a key-frame for frame after frame of its fall."""
    printed = oracles.algorithm_1_as_printed(bump(), 12)
    assert 40 in printed
    assert set(range(54, 66)) <= set(printed)


def test_of_equal_neighbours_the_first_counts():
    """A plateau is one local maximum."""
    assert find_local_maxima(np.array([0, 1, 1, 1, 0, 2, 2, 1.0])).tolist() == [1, 5]
    assert keys([0, 1, 1, 1, 0], 2) == [1]


def test_a_shelf_on_a_slope_is_no_maximum():
    """Equal neighbours that are followed by a rise."""
    assert find_local_maxima(np.array([0, 1, 1, 2, 0.0])).tolist() == [3]


def test_a_constant_curve_and_an_undefined_one_have_no_maximum():
    """Nothing happens in either."""
    assert find_local_maxima(np.full(9, 0.5)).tolist() == []
    assert find_local_maxima(np.full(9, np.nan)).tolist() == []
    assert find_local_maxima(np.array([np.nan, 0.5, 0.5, np.nan])).tolist() == []


def test_only_the_highest_within_the_window_is_a_key_frame():
    """A lower peak nearer than half of ω is dropped; farther away it stays."""
    curve = np.maximum(bump(centre=30, width=3), 0.8 * bump(centre=42, width=3))
    assert keys(curve, 40) == [30]
    assert keys(curve, 10) == [30, 42]


def test_of_equal_peaks_within_the_window_the_first_counts():
    """Not both."""
    assert keys([0, 1, 0, 1, 0, 0, 0, 0, 1, 0], 4) == [1, 8]


def test_low_peaks_are_dropped_by_the_threshold():
    """Below a tenth of the highest, say."""
    curve = np.maximum(bump(centre=20), 0.09 * bump(centre=60))
    assert keys(curve, 10, threshold=0.1) == [20]
    assert keys(curve, 10, threshold=0.05) == [20, 60]


def test_undefined_ends_hide_no_peak():
    """NaN is lower than anything."""
    curve = bump(centre=20)
    curve[:15] = curve[-15:] = np.nan
    assert keys(curve, 20) == [20]
