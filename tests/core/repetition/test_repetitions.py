"""Repetitions: three jumps in a row are one motion, performed three times."""

from itertools import pairwise

import numpy as np
import pytest

from caesura.core.analysis import Features
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, segment
from caesura.core.repetition.period import difference_function, find_period
from caesura.core.repetition.repetition_ends import find_repetition_ends
from caesura.core.repetition.repetitions import RepetitionFinder, find_repetitions
from caesura.core.repetition.segment_features import segment_features
from caesura.formats.read import read_animation
from caesura.samples.figures import FIGURES, figure

RATE = 30.0


def swings(lengths, columns=6, noise=0.01):
    """A motion performed once for every length in frames, each of its own speed, as a descriptor."""
    random = np.random.default_rng(4)
    phase = np.interp(np.arange(sum(lengths)), np.cumsum([0, *lengths]), np.arange(len(lengths) + 1))
    turns = 2 * np.pi * np.outer(phase, [1, 1, 2])
    shown = np.concatenate([np.cos(turns), np.sin(turns)], axis=1) @ random.normal(size=(6, columns))
    return Features("strain", (shown + noise * random.normal(size=shown.shape)).astype(np.float32), 1.0)


def found(feature):
    """Where the repetitions of a take of one motion end."""
    labels = np.zeros(len(feature.values), np.int64)
    (intervals,) = find_repetitions(RepetitionFinder((feature,), RATE), labels)
    assert all(a.end == b.start for a, b in pairwise(intervals))
    assert (intervals[0].start, intervals[-1].end) == (0, len(labels))
    return [interval.end for interval in intervals]


@pytest.mark.parametrize(
    "lengths", [(40, 46), (30, 30, 30), (38, 52, 44, 40, 49), (18,) * 12, (100, 120, 90), (300, 310, 290)]
)
def test_each_repetition_is_found_where_it_ends(lengths):
    """Fast and slow ones, each of its own speed: to within a twentieth of a repetition."""
    np.testing.assert_allclose(found(swings(lengths)), np.cumsum(lengths), atol=np.mean(lengths) / 20)


def test_what_happens_once_is_one_repetition():
    """One swing, a slow drift, and stillness."""
    rising = Features("strain", np.linspace(0, 1, 90, dtype=np.float32)[:, None], 1.0)
    assert found(swings((80,))) == [80]
    assert found(rising) == [90]
    assert found(Features("strain", np.ones((90, 3), np.float32), 1.0)) == [90]
    assert found(Features("strain", np.zeros((90, 0), np.float32), 0.0)) == [90]


@pytest.mark.parametrize("frames", range(1, 12))
def test_segments_of_a_few_frames_are_one_repetition(frames):
    """However short they are."""
    assert found(Features("strain", np.arange(2.0 * frames, dtype=np.float32).reshape(-1, 2), 1.0)) == [frames]


def test_segments_are_looked_at_one_by_one():
    """Two motions of other periods, and each has its own repetitions."""
    one, other = swings((30,) * 5), swings((45,) * 4)
    feature = Features("strain", np.concatenate([one.values, other.values[:, ::-1]]), 1.0)
    labels = np.repeat([0, 1], [len(one.values), len(other.values)])
    assert [len(of_segment) for of_segment in find_repetitions(RepetitionFinder((feature,), RATE), labels)] == [5, 4]


def test_unlikeness_is_that_of_its_definition():
    """Against sums written out."""
    shown = segment_features((swings((31, 40, 35)),), 0, 106, RATE)
    apart = [np.mean([np.sum((b - a) ** 2) for a, b in zip(shown, shown[lag:], strict=False)]) for lag in range(61)]
    slow = [1.0, *(apart[lag] / np.mean(apart[1 : lag + 1]) for lag in range(1, 61))]
    np.testing.assert_allclose(difference_function(shown, 60), slow, rtol=1e-6, atol=1e-9)


def test_beats_of_a_period_that_cannot_fit_are_the_passage():
    """A passage shorter than the fastest repetition."""
    assert find_repetition_ends(np.random.default_rng(0).normal(size=(5, 2)), 30).tolist() == [0, 5]
    assert find_period(np.zeros((0, 3)), RATE) == 0


@pytest.mark.parametrize("name", FIGURES)
def test_the_figures_repetitions_are_counted(name):
    """In nine segments of ten at least, as many as were performed, ending within a tenth of a second in the mean."""
    sample = figure(name)
    truth = sample.truth
    take = read_animation({"figure.glb": sample.glb}, Parameters(), Limits.none(), lambda n: memoryview(bytearray(n)))
    analysis = analyse(take, Parameters())
    labels = np.repeat(np.arange(len(truth.segments)) % 2, [end - start for _, start, end in truth.segments])
    told = find_repetitions(RepetitionFinder.of(analysis), labels)
    right = [(mine, true) for mine, true in zip(told, truth.repeats, strict=True) if len(mine) == len(true)]
    assert len(right) >= 0.9 * len(told)
    misses = [abs(m.end - t) for mine, true in right for m, t in zip(mine, true, strict=True)]
    assert np.mean(misses) < 0.1 * RATE


def test_a_result_says_its_repeats():
    """They tile each segment of the document, for the default method."""
    sample = figure("rigid")
    take = read_animation({"figure.glb": sample.glb}, Parameters(), Limits.none(), lambda n: memoryview(bytearray(n)))
    found = segment(take, Parameters(motions=6))
    counts = [len(s.repeats) for s in found.document().segments]
    assert all(s.repeats[0].start == s.start and s.repeats[-1].end == s.end for s in found.document().segments)
    assert counts == [len(ends) for ends in sample.truth.repeats]
