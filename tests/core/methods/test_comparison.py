"""The methods compared with, each through its own door: they find what is plain, and say what they cannot do."""

import numpy as np
import pytest

from caesura.core.agreement import frame_accuracy
from caesura.core.analysis import Analysis, Features
from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters
from caesura.core.registry.methods import METHODS
from caesura.core.segmentation_document import Source

RATE = 30.0
NAMES = sorted(name for name, method in METHODS.items() if method.needs_motions)


def performance(order=(0, 1, 2, 0, 1), seconds=5.0, seed=0, components=6):
    """Values and truth: each motion swings its own components about its own pose, at its own tempo."""
    random = np.random.default_rng(seed)
    poses = 3 * random.normal(size=(max(order) + 1, components))
    swings = random.normal(size=(max(order) + 1, 2, components))
    truth = np.repeat(order, round(seconds * RATE))
    angle = 2 * np.pi * np.arange(len(truth)) / RATE * (0.8 + 0.2 * truth)
    swing = np.cos(angle)[:, None] * swings[truth, 0] + np.sin(angle)[:, None] * swings[truth, 1]
    return poses[truth] + swing + random.normal(0, 0.02, (len(truth), components)), truth


def analysis_of(values, rate=RATE):
    """An analysis that holds these features, no strain at all, and a flat energy curve."""
    frames = len(values)
    return Analysis(
        frames=frames,
        frame_rate=rate,
        source=Source(take=0, name="take", fps=rate),
        heavy={},
        energy=np.zeros(frames),
        peaks=np.zeros(0, np.int64),
        peak_strain=np.zeros((0, 0), np.float32),
        features=(
            Features("strain", np.zeros((frames, 0), np.float32), 1.0),
            Features("pair-distances", values.astype(np.float32), 1.0),
        ),
        strain_scale=1.0,
    )


def cut(name, values, motions, rate=RATE, seed=0):
    return METHODS[name].load()(analysis_of(values, rate), Parameters(method=name, motions=motions, seed=seed))


@pytest.mark.parametrize(("name", "least"), [("aca", 0.99), ("haca", 0.95), ("luo2014", 0.99), ("spectral", 0.99)])
def test_plain_motions_are_found(name, least):
    """Three motions in five segments, two of them twice; HACA cuts only every third of a second."""
    values, truth = performance()
    assert frame_accuracy(cut(name, values, 3).labels, truth) > least


@pytest.mark.parametrize("name", [name for name in NAMES if name != "ppca"])
def test_they_are_found_at_120_frames_a_second(name):
    """Frames are reduced or not, lengths are of seconds. Of `ppca` nothing is expected: a rise must be a tenth of the
    largest of the take, and where there is no noise the largest has no bound.

    Which frames stand for the others is drawn, and `spectral`, which looks at single ones, hangs on that draw: one of
    ten finds them, on whatever processor.
    """
    values, truth = performance((0, 1, 0), 4.0)
    slow = np.linspace(0, len(values) - 1, 4 * len(values) - 3)
    values = np.stack([np.interp(slow, np.arange(len(values)), column) for column in values.T], axis=1)
    draws, expected = range(10 if name == "spectral" else 1), truth[np.round(slow).astype(int)]
    assert any(frame_accuracy(cut(name, values, 2, rate=120.0, seed=seed).labels, expected) > 0.93 for seed in draws)


@pytest.mark.parametrize("name", NAMES)
def test_the_same_seed_gives_the_same_cut(name):
    """Twice the same labels, to the frame."""
    values, _ = performance((0, 1), 3.0, seed=3)
    np.testing.assert_array_equal(cut(name, values, 2, seed=5).labels, cut(name, values, 2, seed=5).labels)


@pytest.mark.parametrize("name", NAMES)
def test_they_must_be_told_how_many(name):
    """By the method itself, and already where parameters are read, before anything is computed."""
    values, _ = performance((0, 1), 2.0)
    for asked in (lambda: cut(name, values, "auto"), lambda: Parameters.parse({"method": name})):
        with pytest.raises(ParameterError) as refused:
            asked()
        assert refused.value.code == "motions-needed"
        assert refused.value.where["parameter"] == "motions"


@pytest.mark.parametrize(("name", "limit"), [("aca", 5000), ("haca", 5000), ("luo2014", 10_000), ("spectral", 5000)])
def test_a_take_over_the_limit_is_refused(name, limit):
    """One frame too many: the limit, what there is, and what to do."""
    with pytest.raises(ParameterError) as refused:
        cut(name, np.arange(limit + 1.0)[:, None], 2)
    assert refused.value.code == "too-long-for-method"
    assert refused.value.where == {"parameter": "method", "limit": limit, "actual": limit + 1}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("frames", [2, 3, 10, 61])
@pytest.mark.parametrize("motions", [1, 2, 40])
def test_short_takes_are_cut_into_what_there_is(name, frames, motions):
    """Every frame has a label, no more of them than were asked for; fewer are said."""
    values = np.random.default_rng(frames).normal(size=(frames, 2)).cumsum(axis=0)
    found = cut(name, values, motions)
    number = len(np.unique(found.labels))
    assert len(found.labels) == frames
    assert 1 <= number <= motions
    assert [n.code for n in found.notices] == (["fewer-motions"] if number < motions else [])


@pytest.mark.parametrize("name", [name for name in NAMES if name != "pca"])
def test_a_pose_that_is_held_and_another_are_two_motions(name):
    """Frames that are exactly the same, many at once; two poses lie on one line, which is all that `pca` asks."""
    values = np.repeat([[0.0, 1.0], [4.0, 0.0]], 90, axis=0)
    assert frame_accuracy(cut(name, values, 2).labels, np.repeat([0, 1], 90)) > 0.95


@pytest.mark.parametrize("name", NAMES)
def test_where_nothing_deforms_there_is_one_segment(name):
    """However many were asked for."""
    values, _ = performance((0, 1), 2.0)
    still = analysis_of(np.zeros_like(values))
    assert set(METHODS[name].load()(still, Parameters(method=name, motions=3)).labels.tolist()) == {0}
