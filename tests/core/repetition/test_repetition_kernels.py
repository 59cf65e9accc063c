"""The compiled loops of repetitions against twins that look at everything."""

import numpy as np
import pytest

from caesura.core.kernels import repetition

RANDOM = np.random.default_rng(4)


@pytest.mark.parametrize("stride", [1, 3])
def test_the_cheapest_loop_is_the_cheapest_of_all(stride):
    """Of every lag and every frame that is looked at, in pose and in speed."""
    poses = RANDOM.normal(size=(80, 5)).cumsum(axis=0)
    speeds, lags = np.gradient(poses, axis=0), np.arange(20, 40, 2)
    everything = [
        (((poses[a + lag] - poses[a]) ** 2).sum() + 4.0 * ((speeds[a + lag] - speeds[a]) ** 2).sum(), a, lag)
        for lag in lags.tolist()
        for a in range(0, 80 - lag, stride)
    ]
    cost, at, lag = repetition.cheapest_loop(poses, speeds, 4.0, lags, stride)
    assert (at, lag) == min(everything)[1:]
    assert cost == pytest.approx(min(everything)[0])


def test_of_equal_loops_the_first_is_taken():
    """In a take that stands still all of them are alike."""
    still = np.ones((30, 2))
    assert repetition.cheapest_loop(still, 0 * still, 4.0, np.array([7, 9]), 1) == (0.0, 0, 7)


def test_mean_differences_are_those_of_every_window():
    """Cut short at both ends; the end of the last place is judged by the place before it."""
    seen, lags, around = RANDOM.normal(size=(25, 3)), np.array([1, 4, 20]), 2
    found = np.zeros((26, 3))
    repetition.mean_differences(seen, lags, around, found)
    for i, lag in enumerate(lags.tolist()):
        apart = ((seen[lag:] - seen[:-lag]) ** 2).sum(axis=1)
        expected = [apart[max(at - around, 0) : at + around + 1].mean() for at in range(len(apart))]
        np.testing.assert_allclose(found[lag:25, i], expected, rtol=1e-9)
        assert found[25, i] == found[24, i]
        assert not found[:lag, i].any()
