"""Window statistics against plain loops."""

import numpy as np
import pytest

from caesura.core.methods.switching.window_statistics import compute_speeds, compute_window_statistics
from tests import oracles

RANDOM = np.random.default_rng(0)


@pytest.mark.parametrize(("frames", "half"), [(40, 5), (40, 0), (7, 20), (2, 1)])
def test_windows_equal_plain_loops(frames, half):
    """Mean, deviation and RMS speed of every window, those cut short at the ends too."""
    values = RANDOM.normal(size=(frames, 3)) + 100
    mean, deviation, speed = compute_window_statistics(values, half, 30.0, np.arange(frames))
    expected = oracles.windows(values - values.mean(axis=0), half, 30.0)
    np.testing.assert_allclose(mean, expected[0], atol=1e-9)
    np.testing.assert_allclose(deviation, expected[1], atol=1e-6)
    np.testing.assert_allclose(speed, expected[2], atol=1e-9)


def test_only_the_asked_frames_are_answered():
    """Every third frame has the same statistics as when all are asked for."""
    values = RANDOM.normal(size=(50, 2))
    every, third = (compute_window_statistics(values, 4, 30.0, at) for at in (np.arange(50), np.arange(0, 50, 3)))
    for all_of_them, some in zip(every, third, strict=True):
        np.testing.assert_array_equal(all_of_them[::3], some)


def test_what_does_not_change_has_no_deviation_and_no_speed():
    """A constant of float32 size stays exactly still."""
    values = np.full((30, 2), 1234.567, np.float32)
    _, deviation, speed = compute_window_statistics(values, 5, 30.0, np.arange(30))
    assert not deviation.any()
    assert not speed.any()


def test_a_steady_climb_has_its_own_speed():
    """0.1 a frame at 30 frames a second is 3 a second, at the ends too; a single frame has none."""
    np.testing.assert_allclose(compute_speeds(np.arange(9.0)[:, None] * 0.1, 30.0), 3.0)
    assert compute_speeds(np.ones((1, 2)), 30.0).tolist() == [[0.0, 0.0]]
