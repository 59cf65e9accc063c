"""Small motions beside a large one: they are one motion until the large one is out of sight."""

import numpy as np

from caesura.core.agreement import frame_accuracy
from caesura.core.methods.switching.labellings import Labelling, Labellings
from caesura.core.methods.switching.motion_count import MotionCountSearch, _worthiest
from caesura.core.methods.switching.refinement import Refinement
from caesura.core.methods.switching.subdivision import subdivide_motions
from caesura.core.methods.switching.views import VIEWS, Frames, Views
from tests.core.methods.test_switching import RATE, analysis_of, cut

LARGE, SMALL = 40.0, 0.8
STEP = round(RATE / 10)


def one_large_and_three_small(seed):
    """Swings of one component each about one pose, every motion twice, and their truth."""
    random = np.random.default_rng(seed)
    order = [0, 1, 2, 0, 3, 1, 3, 2]
    lengths = [int(RATE * random.uniform(3, 5)) for _ in order]
    parts = []
    for motion, length in zip(order, lengths, strict=True):
        angle = 2 * np.pi * np.arange(length) / RATE / (0.8 + 0.1 * motion)
        part = np.zeros((length, 8))
        part[:, 2 * motion] = (LARGE if motion == 0 else SMALL) * np.cos(angle)
        part[:, 2 * motion + 1] = (LARGE if motion == 0 else SMALL) * np.sin(angle)
        parts.append(part)
    return np.concatenate(parts) + random.normal(0, 0.005, (sum(lengths), 8)), np.repeat(order, lengths)


def test_small_motions_beside_a_large_one_are_found():
    """Told how many, and not told: in no view of the whole take do they differ by more than a fiftieth."""
    values, truth = one_large_and_three_small(seed=2)
    for motions in (4, "auto"):
        found = cut(analysis_of(values), motions).labels
        assert len(np.unique(found)) == 4
        assert frame_accuracy(found, truth) > 0.97


def labellings(*cuts, subdivided=()):
    """One labelling for each number of motions from 1 on, of these normalised cuts."""
    return {
        motions: Labelling(np.zeros(1, np.int64), (), VIEWS[0], cut, motions, 0.0, int(motions in subdivided))
        for motions, cut in enumerate(cuts, 1)
    }


def test_a_motion_is_one_that_adds_no_more_than_it_is_worth():
    """A third; and of a take whose motions are seldom parted less, of one in which all are dear more."""
    assert _worthiest(labellings(0.0, 0.3, 0.6, 1.2)).motions == 3
    assert _worthiest(labellings(0.0, 0.02, 0.04, 0.06, 0.2)).motions == 4
    assert _worthiest(labellings(0.0, 0.22, 0.45, 0.86, 1.5)).motions == 4
    assert _worthiest(labellings(0.0, 0.4)).motions == 1


def test_two_motions_that_are_worth_it_together_are_both_found():
    """One more alone is dear, two more are cheap: the number between is passed over."""
    assert _worthiest(labellings(0.0, 0.1, 0.5, 0.55)).motions == 4


def test_a_subdivision_must_be_cut_less():
    """It was looked for, motion by motion: what chance finds is no motion."""
    assert _worthiest(labellings(0.0, 0.2, 0.55)).motions == 3
    assert _worthiest(labellings(0.0, 0.2, 0.55, subdivided=(3,))).motions == 2


def test_a_subdivision_takes_the_place_of_a_labelling_only_where_it_is_clearly_better():
    """Of as many motions, by a tenth."""
    whole = labellings(0.0, 0.2)[2]
    close, better = labellings(0.0, 0.15, subdivided=(2,))[2], labellings(0.0, 0.05, subdivided=(2,))[2]
    for other, expected in ((close, whole), (better, better)):
        nothing = Labellings(Views(Frames.of(analysis_of(np.zeros((9, 1))))), Refinement(np.zeros((9, 0)), RATE))
        search = MotionCountSearch(nothing, {(VIEWS[0], 2): whole, b"other": other})
        assert search.best()[2] is expected


def test_no_half_of_a_motion_is_shorter_than_a_window():
    """At the ends of a segment the windows reach into the next: a glimpse of the other half is none."""
    values, truth = one_large_and_three_small(seed=2)
    merged = np.where(truth == 0, 0, 1)
    divided = list(subdivide_motions(merged, Views(Frames.of(analysis_of(values)))))
    assert divided
    for view, labels in divided:
        bounds = np.flatnonzero(np.diff(labels, prepend=-1, append=-1))
        assert np.diff(bounds).min() >= view.seconds * RATE - 2 * STEP
