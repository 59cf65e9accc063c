"""Separation: performances of one motion lie near each other, motions apart; the count follows."""

import numpy as np
import pytest

from caesura.core.methods.switching.motion_count import count_separate_motions
from caesura.core.methods.switching.separation import measure_separations
from caesura.core.methods.switching.switching_k_means import SwitchingClusters
from caesura.core.methods.switching.windowed_signal import WindowedSignal

STEPS = 60


def signal(centres, strays=0.01):
    """A take that stands at one centre after the other, a step a tenth of a second, straying a little."""
    random = np.random.default_rng(1)
    values = np.repeat(np.array(centres, float), STEPS, axis=0)
    values = values + random.normal(0, strays, values.shape)
    return WindowedSignal(values, values * 0, values * 0, 3, 3 * len(values), 0.1)


def settled(found, motions):
    labels = np.repeat(np.arange(motions), STEPS)
    return SwitchingClusters(labels, np.stack([found.values[labels == k].mean(axis=0) for k in range(motions)]), 0.0)


@pytest.mark.parametrize(("distance", "motions"), [(0.1, 2), (0.25, 2), (0.4, 3), (1.0, 3)])
def test_what_lies_near_is_one_motion_however_still_it_was_held(distance, motions):
    """Habits of the day set performances apart by far more than each strays; motions lie farther apart than that."""
    found = signal([[0, 0], [1, 0], [1, distance]])
    assert count_separate_motions(found, settled(found, 3)) == motions


def test_one_motion_that_strays_as_far_is_not_two():
    """Two halves of a wide cloud are near in its own measure."""
    found = signal([[0, 0], [1, 0]], strays=0.8)
    assert measure_separations(found, settled(found, 2).labels, 2)[0, 1] < 1


def test_a_motion_is_apart_from_itself():
    """The diagonal never joins anything."""
    found = signal([[0, 0], [1, 0]])
    assert np.isinf(np.diag(measure_separations(found, settled(found, 2).labels, 2))).all()
