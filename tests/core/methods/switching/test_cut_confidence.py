"""Certainty: cuts that gain little, or stand beside what was hardly seen, are less sure."""

import numpy as np
import pytest

from caesura.core.methods.switching.cut_confidence import cut_confidence
from caesura.core.methods.switching.switching_k_means import SwitchingClusters
from caesura.core.methods.switching.windowed_signal import WindowedSignal


def sure(centres, lengths):
    """The certainty of the cuts of a take that stands at one centre after the other, a step a tenth of a second."""
    values = np.repeat(np.array(centres, float)[:, None], lengths, axis=0)
    found = WindowedSignal(values, values * 0, values * 0, 3, 3 * len(values), 0.1)
    means, labels = np.unique(centres, return_inverse=True)
    return cut_confidence(
        found, SwitchingClusters(np.repeat(labels, lengths), means[:, None].astype(float), 0.0), penalty=10 / 3
    )


def test_a_smaller_change_is_less_sure():
    """0 to 1 is less than 1 to 3."""
    one, other = sure([0, 1, 3], [60, 60, 60])
    assert one < other < 1


@pytest.mark.parametrize("short", [5, 10])
def test_a_cut_beside_a_short_segment_is_less_sure(short):
    """Windows see no more than a blur of what is shorter than they are; longer than that, the length says nothing."""
    before, after = sure([0, 1, 3], [60, short, 60])
    long_before, long_after = sure([0, 1, 3], [60, 60, 60])
    assert before < long_before * short / 20
    assert after < long_after * short / 20


def test_a_cut_that_gains_nothing_is_not_sure_at_all():
    """Both sides are at the same place."""
    values = np.zeros((80, 1))
    found = WindowedSignal(values, values, values, 3, 240, 0.1)
    settled = SwitchingClusters(np.repeat([0, 1], 40), np.zeros((2, 1)), 0.0)
    assert cut_confidence(found, settled, penalty=10 / 3)[0] == 0
