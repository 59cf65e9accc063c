"""The number of motions: each must be worth what it adds to the normalised cut."""

import numpy as np
import pytest

from caesura.core.methods.switching.labellings import Labelling, Labellings
from caesura.core.methods.switching.motion_count import MotionCountSearch
from caesura.core.methods.switching.refinement import Refinement
from caesura.core.methods.switching.views import VIEWS, Frames, Views
from tests.core.methods.test_switching import RATE, analysis_of

NOTHING = Labellings(Views(Frames.of(analysis_of(np.zeros((9, 1))))), Refinement(np.zeros((9, 0)), RATE))
HALVES = np.repeat([0, 1], 30)
THIRDS = np.repeat([0, 1, 2], 20)
OTHER_THIRDS = np.tile([0, 1, 2], 20)


def labelling(motions, cut, seconds=4.0, subdivided=0, labels=THIRDS, view=VIEWS[0]):
    """One labelling, of segments that last so long."""
    return Labelling(labels, (), view, cut, motions, 0.0, seconds, subdivided)


def chosen(*labellings):
    """How many motions are found worth it, of these labellings."""
    return MotionCountSearch(NOTHING, dict(enumerate(labellings)))._worthiest().motions


def counted(*cuts, seconds=4.0, subdivided=()):
    """The same of one labelling for each number of motions from 1 on, of these normalised cuts."""
    return chosen(*(labelling(k, cut, seconds, int(k in subdivided)) for k, cut in enumerate(cuts, 1)))


def test_a_motion_is_one_that_adds_no_more_than_it_is_worth():
    """Where segments last four seconds, three tenths."""
    assert counted(0.0, 0.3, 0.6, 1.0) == 3
    assert counted(0.0, 0.31) == 1


@pytest.mark.parametrize(("seconds", "worth"), [(2.0, 0.43), (4.0, 0.305), (25.0, 0.122)])
def test_a_motion_is_worth_less_where_segments_last_long(seconds, worth):
    """By the root of their seconds, for fewer links lead out at their ends."""
    assert counted(0.0, worth - 0.01, seconds=seconds) == 2
    assert counted(0.0, worth + 0.01, seconds=seconds) == 1


def test_two_motions_that_are_worth_it_together_are_both_found():
    """One more alone is dear, two more are cheap: the number between is passed over."""
    assert counted(0.0, 0.1, 0.5, 0.55) == 4


def test_a_subdivision_must_be_cut_less():
    """It was looked for, motion by motion: what chance finds is no motion."""
    assert counted(0.0, 0.2, 0.48) == 3
    assert counted(0.0, 0.2, 0.48, subdivided=(3,)) == 2


def test_a_subdivision_takes_the_place_of_a_labelling_only_where_it_is_clearly_better():
    """Of as many motions, by a tenth."""
    whole, close, better = labelling(2, 0.2), labelling(2, 0.15, subdivided=1), labelling(2, 0.05, subdivided=1)
    for other, expected in ((close, whole), (better, better)):
        assert MotionCountSearch(NOTHING, {0: whole, 1: other}).best()[2] is expected


def seen_by_views(thirds):
    """One motion; the same two in all views; and a third which adds a little less than it may, and is in a view each
    what these labels say."""
    views = VIEWS[: len(thirds)]
    one = labelling(1, 0.0, labels=HALVES * 0)
    two = [labelling(2, 0.2 + i / 1000, labels=HALVES, view=view) for i, view in enumerate(views)]
    three = zip(thirds, views, strict=True)
    return one, *two, *(labelling(3, 0.49 + i / 1000, labels=t, view=v) for i, (t, v) in enumerate(three))


def test_a_motion_on_which_the_views_disagree_is_worth_less():
    """All see it: it is one. Each sees another: it is none. One of six sees another: it may be mistaken."""
    assert chosen(*seen_by_views([THIRDS] * 5)) == 3
    assert chosen(*seen_by_views([THIRDS] + [OTHER_THIRDS] * 4)) == 2
    assert chosen(*seen_by_views([THIRDS] * 5 + [OTHER_THIRDS])) == 3


def test_two_views_cannot_disagree():
    """With one other view nothing is said: long takes are seen in two only."""
    assert chosen(*seen_by_views([THIRDS, OTHER_THIRDS])) == 3
