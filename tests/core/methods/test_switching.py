"""The default method through its own door: an analysis in, a cut out."""

from dataclasses import replace

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from caesura.core.agreement import boundary_scores, cut_frames, frame_accuracy
from caesura.core.analysis import Analysis, Features
from caesura.core.document import Source
from caesura.core.methods.switching.method import switching
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from tests.animations import animation, bar, turned

RATE = 30.0


def performance(motions, segments, seed, components=12):
    """Features and truth of made-up motions: each swings its own components about its own pose.

    Every repetition has its own speed and size, and motions fade into each other within half a second.
    """
    random = np.random.default_rng(seed)
    poses = random.normal(0, 1, (motions, components))
    swings = random.normal(0, 1, (motions, 2, components))
    periods = random.uniform(0.6, 1.6, motions)
    order = [*range(motions), *random.integers(0, motions, segments - motions)]
    order = [m for m, before in zip(order, [-1, *order], strict=False) if m != before]
    lengths = [int(RATE * random.uniform(3, 7)) for _ in order]
    truth = np.repeat(order, lengths)
    shown = np.zeros((len(truth), components))
    for start, length, m in zip(np.cumsum([0, *lengths]), lengths, order, strict=False):
        angle = 2 * np.pi * np.arange(length) / RATE / periods[m] * random.uniform(0.9, 1.1)
        size = random.uniform(0.9, 1.1)
        swing = np.cos(angle)[:, None] * swings[m, 0] + np.sin(angle)[:, None] * swings[m, 1]
        shown[start : start + length] = poses[m] + size * swing
    fade = np.ones(16) / 16
    shown = np.stack([np.convolve(np.pad(c, 8, "edge"), fade, "same")[8:-8] for c in shown.T], axis=1)
    return shown + random.normal(0, 0.02, shown.shape), truth


def analysis_of(*values):
    """An analysis that holds these features and a flat energy curve."""
    frames = len(values[0])
    names = ("strain", "pair-distances")
    return Analysis(
        frames=frames,
        frame_rate=RATE,
        source=Source(take=0, name="take", fps=RATE),
        heavy={},
        energy=np.zeros(frames),
        peaks=np.zeros(0, np.int64),
        peak_strain=np.zeros((0, 0), np.float32),
        features=tuple(Features(n, v.astype(np.float32), 1.0) for n, v in zip(names, values, strict=False)),
        strain_scale=1.0,
    )


def cut(analysis, motions):
    return switching(analysis, Parameters(motions=motions))


@pytest.mark.parametrize(("motions", "segments"), [(2, 4), (3, 7), (8, 16), (15, 32), (30, 70)])
def test_motions_are_found(motions, segments):
    """Told how many, the motions and their cuts are found, few or many."""
    values, truth = performance(motions, segments, seed=motions)
    labels = cut(analysis_of(values), motions).labels
    assert frame_accuracy(labels, truth) > 0.97
    assert boundary_scores(cut_frames(labels), cut_frames(truth), round(0.5 * RATE)).f1 > 0.95


@pytest.mark.parametrize(("motions", "segments"), [(1, 1), (2, 4), (3, 7), (8, 16), (15, 32), (30, 70)])
def test_their_number_is_found(motions, segments):
    """Nobody says how many: 1, 3 or 30 are counted alike, and the cost of every number tried is told."""
    values, _ = performance(motions, segments, seed=100 + motions)
    found = cut(analysis_of(values), "auto")
    assert len(np.unique(found.labels)) == motions
    assert [score.motions for score in found.scores] == list(range(1, len(found.scores) + 1))
    assert found.scores[0].score == 1
    assert all(0 <= score.score <= 1 for score in found.scores)


def test_every_cut_has_a_confidence():
    """One number from 0 to 1 for each change of label."""
    values, _ = performance(4, 9, seed=3)
    found = cut(analysis_of(values), 4)
    assert len(found.confidence) == len(cut_frames(found.labels))
    assert ((found.confidence > 0) & (found.confidence <= 1)).all()


def test_a_weaker_change_is_less_sure():
    """Two motions that differ little are cut with less confidence than two that differ much."""
    values, truth = performance(2, 2, seed=5)
    stranger = np.concatenate([values, values[truth == truth[-1]] + 0.4, values[truth == truth[0]] + 6])
    found = cut(analysis_of(stranger), 4)
    assert len(found.confidence) == 3
    assert found.confidence[1] < found.confidence[2]


def test_a_take_backwards_is_cut_in_the_same_places():
    """Time reversed, the cuts are mirrored, to within a tenth of a second."""
    values, _ = performance(5, 11, seed=7)
    forwards, backwards = (cut_frames(cut(analysis_of(v), 5).labels) for v in (values, values[::-1]))
    assert len(forwards) == len(backwards)
    np.testing.assert_allclose(np.sort(len(values) - backwards), forwards, atol=3)


def test_units_do_not_matter():
    """Features a thousand times as large give the same labels."""
    values, _ = performance(4, 8, seed=9)
    small, large = (cut(analysis_of(v), "auto").labels for v in (values, values * 1000))
    np.testing.assert_array_equal(small, large)


def test_either_descriptor_alone_will_do():
    """A body of rigid parts has no strain, and a cloth may have no far points: what is there decides."""
    values, truth = performance(4, 8, seed=11)
    nothing = np.zeros((len(values), 0))
    for analysis in (analysis_of(nothing, values), analysis_of(values, nothing)):
        assert frame_accuracy(cut(analysis, 4).labels, truth) > 0.97


@pytest.mark.parametrize("motions", [1, 3, "auto"])
def test_a_body_that_does_not_change_is_one_segment(motions):
    """No features, or features that are constant: one motion, no cut."""
    for still in (np.zeros((90, 0)), np.full((90, 3), 0.5)):
        found = cut(analysis_of(still), motions)
        assert found.labels.tolist() == [0] * 90
        assert found.confidence.size == 0


@pytest.mark.parametrize("frames", [2, 3, 5, 20])
@pytest.mark.parametrize("motions", [1, 2, 7, "auto"])
def test_the_shortest_takes_have_labels(frames, motions):
    """Two frames are a take: every frame has a label, and fewer motions than asked for are said so."""
    values = np.random.default_rng(frames).normal(size=(frames, 3))
    found = cut(analysis_of(values), motions)
    assert len(found.labels) == frames
    if motions == 7:
        assert [notice.code for notice in found.notices] == ["fewer-motions"] or len(np.unique(found.labels)) == 7


def test_as_many_motions_as_asked_for():
    """Five asked of a take of three: five are given, by lowering the price of a piece."""
    values, _ = performance(3, 6, seed=13)
    assert len(np.unique(cut(analysis_of(values), 5).labels)) == 5


def test_the_same_take_is_cut_the_same_way():
    """Twice the same analysis, the same bytes."""
    values, _ = performance(6, 13, seed=15)
    one, other = (cut(analysis_of(values), "auto") for _ in range(2))
    assert one.labels.tobytes() == other.labels.tobytes()
    assert one.confidence.tobytes() == other.confidence.tobytes()


def test_the_rate_of_the_frames_hardly_matters():
    """Every second frame at half the rate gives the same cuts, to within two frames."""
    values, _ = performance(4, 9, seed=17)
    full = analysis_of(values)
    half = replace(analysis_of(values[::2]), frame_rate=RATE / 2)
    np.testing.assert_allclose(cut_frames(cut(half, 4).labels) * 2, cut_frames(cut(full, 4).labels), atol=4)


def test_the_number_of_threads_does_not_matter():
    """One BLAS thread or two around it: the same labels and the same confidences, to the byte."""
    values, _ = performance(8, 17, seed=19)
    found = []
    for threads in (1, 2):
        with threadpool_limits(threads):
            found.append(cut(analysis_of(values), "auto"))
    assert found[0].labels.tobytes() == found[1].labels.tobytes()
    assert found[0].confidence.tobytes() == found[1].confidence.tobytes()


def test_walking_about_changes_nothing():
    """The same performance carried through space on a spinning stage is cut in the same places."""
    rest, triangles = bar()
    time = np.arange(480)[:, None] / RATE
    bend = np.where(time < 8, np.sin(6 * time), 0.3 + 0.2 * np.sin(11 * time)) * (rest[:, 0] ** 2)
    sway = np.where(time < 8, 0.1, 0.5 * np.sin(11 * time)) * rest[:, 0]
    performed = rest + np.stack([0 * bend, bend, sway], axis=2)
    carried = np.stack([turned(f, i / 40) + np.array([i / 30, 0, i / 60]) for i, f in enumerate(performed)])
    one, other = (segment(animation(v, triangles, rest=rest)).labels for v in (performed, carried))
    np.testing.assert_array_equal(cut_frames(one), [pytest.approx(240, abs=4)])
    np.testing.assert_allclose(cut_frames(other), cut_frames(one), atol=1)
