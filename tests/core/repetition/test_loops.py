"""Loops: the whole repetitions after which pose and speed are what they were."""

import numpy as np
import pytest

from caesura.core.analysis import Features
from caesura.core.repetition.loops import LoopFinder, find_loops
from caesura.core.repetition.repetitions import RepetitionFinder, find_repetitions
from caesura.core.segmentation_document import Interval

RATE = 30.0


def swinging(frames: int, period: float, noise: float = 0.0) -> Features:
    """A pendulum seen from the side, in pose; its speed tells to from fro."""
    time = 2 * np.pi * np.arange(frames) / period
    shown = np.stack([np.sin(time), 0.3 * np.sin(2 * time + 1), 0.2 * np.cos(3 * time)], axis=1)
    return Features(
        "strain", (shown + noise * np.random.default_rng(3).normal(size=shown.shape)).astype(np.float32), 1.0
    )


def loop_of(feature: Features):
    """The best loop of a take of one motion."""
    labels = np.zeros(len(feature.values), np.int64)
    repeats = find_repetitions(RepetitionFinder((feature,), RATE), labels)
    (found,) = find_loops(LoopFinder((feature,), RATE), labels, repeats)
    return found


@pytest.mark.parametrize("period", [20, 31, 60])
def test_a_loop_is_a_whole_number_of_repetitions(period):
    """Of an even motion: exactly its period, and the seam is nothing."""
    found = loop_of(swinging(7 * period, period))
    assert (found.end - found.start) == found.cycles * period
    assert found.seam < 0.05
    assert found.match == "good"


def test_more_repetitions_are_taken_only_where_they_match_better():
    """A period of 20.5 frames: two of them are a whole number of frames, and one is half a frame off."""
    found = loop_of(swinging(200, 20.5))
    assert found.cycles * 20.5 == pytest.approx(found.end - found.start, abs=0.5)
    assert found.seam <= 0.6
    assert loop_of(swinging(240, 40, noise=0.02)).cycles == 1


def test_the_best_of_all_loops_is_found():
    """No frames one repetition apart are more alike, by an obvious search through all of them."""
    feature = swinging(150, 25, noise=0.05)
    found = loop_of(feature)
    poses = feature.values.astype(np.float64) - feature.values.mean(axis=0)
    speeds = np.gradient(poses, axis=0)
    lags = range(int(25 * found.cycles * 0.9), int(25 * found.cycles * 1.1) + 1)
    cost = {
        (a, a + lag): np.sum((poses[a + lag] - poses[a]) ** 2) + 4 * np.sum((speeds[a + lag] - speeds[a]) ** 2)
        for lag in lags
        for a in range(150 - lag)
    }
    assert min(cost, key=cost.__getitem__) == (found.start, found.end)


def test_a_take_of_one_repetition_loops_where_its_end_is_its_beginning():
    """As games have walks: one cycle, whose last pose is the first. A rising arm has no loop."""
    found = loop_of(swinging(31, 30))
    assert (found.start, found.end, found.cycles) == (0, 30, 1)
    rising = Features("strain", np.linspace(0, 1, 90, dtype=np.float32)[:, None], 1.0)
    assert loop_of(rising) is None


@pytest.mark.parametrize("frames", range(1, 8))
def test_a_few_frames_and_stillness_have_no_loop_or_a_plain_one(frames):
    """However short; nothing divides by nothing."""
    assert loop_of(Features("strain", np.ones((frames, 3), np.float32), 1.0)) is None
    found = loop_of(Features("strain", np.arange(2.0 * frames, dtype=np.float32).reshape(-1, 2), 1.0))
    assert found is None or 0 <= found.start < found.end < frames


def test_a_few_frames_of_very_many_a_second_have_no_loop():
    """A frame in so many is looked at first; a segment may have fewer."""
    feature = swinging(20, 7)
    labels = np.zeros(20, np.int64)
    assert find_loops(LoopFinder((feature,), 3000.0), labels, [[Interval(start=0, end=20)]]) == (None,)


def test_a_long_segment_is_searched_about_its_middle_in_bounded_time():
    """Forty minutes of one swing: frames far apart are not compared."""
    found = loop_of(swinging(72_000, 40))
    assert found.end - found.start == 40 * found.cycles
    assert 30_000 < found.start < 42_000
