"""Sheets: clips laid end to end are recognised and cut at their ends; performances are not taken for sheets."""

from itertools import pairwise

import numpy as np
import pytest

from caesura.core.agreement import frame_accuracy
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from tests.animations import animation, bar, performing_bar

RATE = 30.0
LENGTHS = (40, 12, 60, 24, 50)


def clips(lengths=LENGTHS, times=1):
    """A bar that bends its own places in every clip, whose last pose is its first; and the clip of every frame."""
    rest, triangles = bar()
    shown = []
    for number, length in enumerate(lengths * times):
        swing = np.sin(2 * np.pi * np.arange(length) / (length - 1))[:, None] * (0.1 + 0.05 * number)
        place = np.exp(-(((rest[:, 0] - 0.15 - 0.17 * (number % len(lengths))) / 0.12) ** 2))
        moved = rest + np.stack([0 * swing * place, swing * place, 0.5 * swing**2 * place], axis=2)
        shown.append(moved + np.stack([0 * place, 0.05 * (number + 1) * rest[:, 0] ** 2, 0 * place], axis=1))
    return animation(np.concatenate(shown), triangles, rest=rest), np.repeat(np.arange(len(shown)), lengths * times)


@pytest.mark.parametrize("motions", ["auto", 5])
def test_a_sheet_is_cut_at_its_clips(motions):
    """Told how many or not; the result says what the take was taken for, and why."""
    sheet, truth = clips()
    found = segment(sheet, Parameters(motions=motions))
    assert found.kind == found.document().kind == "sheet"
    assert [notice.code for notice in found.notices if "sheet" in notice.code] == ["taken-for-a-sheet"]
    assert frame_accuracy(found.labels, truth) > 0.97
    assert found.motions == 5
    assert ((found.confidence >= 0) & (found.confidence <= 1)).all()


@pytest.mark.parametrize("frames", [20, 50])
def test_the_way_from_one_clip_to_the_next_is_no_clip(frames):
    """Where a spline leads from the last key of a clip to the first of the next, however long; cut in its middle."""
    sheet, _ = clips()
    shown = np.split(sheet.vertices(0, sheet.frames), np.cumsum(LENGTHS)[:-1])
    t = (np.arange(1, frames + 1) / (frames + 1))[:, None, None]
    ways = [one[-1] + (other[0] - one[-1]) * t**2 * (3 - 2 * t) for one, other in pairwise(shown)]
    pieces = [piece for pair in zip(shown, [*ways, []], strict=True) for piece in pair if len(piece)]
    joined = animation(np.concatenate(pieces), sheet.triangles, rest=sheet.rest)
    found = segment(joined, Parameters())
    middles = np.cumsum(LENGTHS)[:-1] + frames * (np.arange(4) + 0.5)
    np.testing.assert_allclose(found.cuts, middles, atol=2)
    np.testing.assert_allclose(np.diff(found.transitions)[:, 0], frames, atol=3)


def test_a_clip_that_passes_its_first_pose_may_be_two():
    """The middle of a long swing is a candidate for a cut, less likely than not; short swings have none."""
    sheet, _ = clips((120, 20, 60))
    ((frame, likely),) = segment(sheet, Parameters()).candidates
    assert abs(frame - 60) <= 2
    assert 0.1 <= likely < 0.5
    assert segment(clips()[0], Parameters()).candidates == ()


def test_what_a_person_expects_goes_first():
    """The same sheet as a performance, and a performance as a sheet."""
    sheet, _ = clips()
    assert segment(sheet, Parameters(expect="performance")).kind == "performance"
    performance = performing_bar([0, 1, 0]).animation
    assert segment(performance, Parameters()).kind == "performance"
    found = segment(performance, Parameters(expect="sheet"))
    assert (found.kind, found.notices) == ("sheet", ())


def test_more_clips_than_fit_are_as_many_as_fit():
    """None is shorter than three tenths of a second."""
    sheet, _ = clips((30, 30))
    found = segment(sheet, Parameters(motions=50, expect="sheet"))
    assert found.motions == 6
    assert found.notices[-1].code == "other-number-of-clips"


def test_one_clip_asked_of_a_long_take_is_as_few_as_there_can_be():
    """A clip lasts fifteen seconds at most."""
    found = segment(performing_bar([0, 1, 0]).animation, Parameters(motions=1, expect="sheet"))
    assert found.motions == 2
    assert found.notices[-1].code == "other-number-of-clips"


@pytest.mark.parametrize("frames", [2, 10, 20])
def test_the_shortest_takes_may_be_expected_to_be_sheets(frames):
    """Where no two clips fit the take is cut as a performance."""
    rest, triangles = bar()
    bent = rest + np.linspace(0, 1, frames)[:, None, None] * np.stack([0 * rest[:, 0], rest[:, 0] ** 2, rest[:, 2]], 1)
    assert len(segment(animation(bent, triangles, rest=rest), Parameters(expect="sheet")).labels) == frames
