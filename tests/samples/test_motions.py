"""Motions: the same thing again and again, and never twice the same."""

import numpy as np
import pytest

from caesura.samples.motions import Motion
from caesura.samples.repertoire import MOTIONS
from caesura.samples.skeleton import AXES, HUMAN

RATE = 30.0
NOD = Motion("nod", 1.0, {"head flex": ((0, 0), (0.5, 20))})


def performed(motion, repetitions=4, seed=1):
    """A performance and the frames at which its repetitions end."""
    random = np.random.default_rng(seed)
    ends = motion.ends(repetitions, RATE, random)
    return motion.perform(np.arange(ends[-1]), ends, random), ends


def test_every_repetition_has_its_own_speed_and_size():
    """Durations and the tops of the curve differ from one repetition to the next, within reason."""
    course, ends = performed(NOD, repetitions=8)
    lengths = np.diff([0, *ends])
    head = course.angles[:, HUMAN.index("head"), AXES.index("flex")]
    tops = [head[round(a) : round(b)].max() for a, b in zip([0, *ends], ends, strict=False)]
    for values in (lengths, tops):
        assert 0.02 < np.std(values) / np.mean(values) < 0.3


def test_the_last_repetition_is_whole():
    """A performance lasts a whole number of frames, near repetitions times the usual length."""
    ends = NOD.ends(10, RATE, np.random.default_rng(5))
    assert ends[-1] == round(ends[-1])
    assert 0.7 * 300 < ends[-1] < 1.4 * 300


def test_a_gait_moves_the_right_side_half_a_repetition_later():
    """Walking legs swing against each other."""
    course, _ = performed(MOTIONS["walk"], repetitions=8)
    left, right = (course.angles[:, HUMAN.index("thigh" + side), 0] for side in (".L", ".R"))
    assert np.corrcoef(left, right)[0, 1] < -0.5


@pytest.mark.parametrize("name", MOTIONS)
def test_no_motion_jumps(name):
    """From frame to frame no angle moves more than a body could: under 1,800 degrees a second."""
    course, _ = performed(MOTIONS[name])
    assert np.abs(np.diff(course.angles, axis=0)).max() < 1800 / RATE


def test_there_are_motions_enough():
    """At least fifteen, each with a name of its own."""
    assert len(MOTIONS) >= 15
    assert all(name == motion.name for name, motion in MOTIONS.items())
