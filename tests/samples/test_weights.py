"""Skin weights: shares of bones that go over smoothly from one to the next."""

import numpy as np
import pytest

from caesura.samples.surface import Limb, skin
from caesura.samples.weights import heat_weights, strongest


@pytest.fixture(scope="module")
def arm():
    """A straight arm of two bones that meet at x = 0.5."""
    places = [np.array([x, 0.0, 0.0]) for x in (0.0, 0.5, 1.0)]
    limbs = [Limb(0, places[0], places[1], 0.1, 0.1), Limb(1, places[1], places[2], 0.1, 0.1)]
    return skin(limbs, 0.03), limbs


def test_weights_are_shares(arm):
    """They lie between 0 and 1 and sum to 1."""
    weights = heat_weights(*arm, bones=2, sharpness=1.0)
    assert ((weights >= 0) & (weights <= 1)).all()
    assert np.allclose(weights.sum(axis=1), 1)


def test_bones_share_evenly_where_they_meet_and_fade_with_distance(arm):
    """Half and half at the joint, nearly all at the far ends, and ever less on the way."""
    surface, limbs = arm
    second = heat_weights(surface, limbs, bones=2, sharpness=1.0)[:, 1]
    x = surface.vertices[:, 0]
    assert np.allclose(second[np.abs(x - 0.5) < 0.01], 0.5, atol=0.1)
    assert second[x < 0.1].max() < 0.05
    assert second[x > 0.9].min() > 0.95
    bands = [second[np.abs(x - middle) < 0.05].mean() for middle in np.arange(0.05, 1.0, 0.1)]
    assert (np.diff(bands) > 0).all()


def test_a_sharper_joint_is_narrower(arm):
    """Sharpness says how fast one bone gives way to the other."""
    soft, sharp = (heat_weights(*arm, bones=2, sharpness=s)[:, 1] for s in (0.3, 10.0))
    assert ((sharp > 0.1) & (sharp < 0.9)).sum() < ((soft > 0.1) & (soft < 0.9)).sum()


def test_four_bones_are_kept_and_the_fifth_fades_out():
    """Shares of the four strongest sum to 1, and a fourth equal to the fifth has none left: nothing can tear."""
    joints, kept = strongest(np.array([[0.1, 0.1, 0.2, 0.25, 0.35]]))
    assert np.isclose(kept.sum(), 1)
    assert joints[0, :3].tolist() == [4, 3, 2]
    assert kept[0, 3] == 0
