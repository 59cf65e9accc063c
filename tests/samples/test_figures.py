"""The sample files: read back through the project's own reader, they hold what their truth says."""

from itertools import pairwise

import numpy as np
import pytest

from caesura.core.agreement import frame_accuracy
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from caesura.samples.figures import FIGURES, figure
from caesura.samples.session import PLAYED, long_session, schedule
from caesura.samples.take import RATE
from tests.formats.opening import opened

QUICK = 6_000  # frames of a session short enough for a test


@pytest.fixture(scope="module")
def session():
    """A short session."""
    return long_session(QUICK)


def check_truth(truth, frames):
    """Segments tile the take, and each is of another motion than the one before."""
    assert truth.frames == frames
    assert [start for _, start, _ in truth.segments] == [0, *[end for _, _, end in truth.segments[:-1]]]
    assert truth.segments[-1][2] == frames
    labels = [label for label, _, _ in truth.segments]
    assert all(one != next_one for one, next_one in pairwise(labels))


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_reads_back_finite_and_as_long_as_its_truth(name):
    """A body of human height, 30 frames a second, and a truth that tiles the take."""
    sample = figure(name)
    take = opened(sample.glb)
    vertices = take.vertices(0, take.frames)
    assert np.isfinite(vertices).all()
    assert take.frame_rate == RATE
    assert 1.7 < np.ptp(take.rest[:, 1]) < 2.1
    check_truth(sample.truth, take.frames)


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_performs_five_motions_and_comes_back_to_some(name):
    """Half a minute to a minute, at least five motions, at least two of them more than once."""
    truth = figure(name).truth
    labels = [label for label, _, _ in truth.segments]
    assert 30 <= truth.frames / RATE <= 65
    assert len(set(labels)) >= 5
    assert sum(labels.count(label) > 1 for label in set(labels)) >= 2


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_is_the_same_bytes_each_time(name):
    """Made anew, it is the same file."""
    assert figure.__wrapped__(name) == figure(name)


def test_the_smooth_figure_is_one_welded_surface():
    """Every edge of its mesh has two triangles, and there is a single piece."""
    triangles = opened(figure("smooth").glb).triangles
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    pairs, shared = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    assert (shared == 2).all()
    assert len(np.unique(triangles)) - len(pairs) + len(triangles) == 2


def test_the_rigid_figures_parts_do_not_strain():
    """The sides of every triangle keep their lengths through the take."""
    take = opened(figure("rigid").glb)
    vertices = take.vertices(0, take.frames)[::20].astype(np.float64)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        sides = np.linalg.norm(vertices[:, take.triangles[:, a]] - vertices[:, take.triangles[:, b]], axis=2)
        assert np.abs(sides - sides[0]).max() < 1e-5


def test_a_session_has_exactly_the_frames_asked_for(session):
    """The truth and the file agree on it."""
    check_truth(session.truth, QUICK)
    assert opened(session.glb).frames == QUICK


def test_a_session_begins_with_a_t_pose_and_ends_in_stillness(session):
    """As in a studio; and no segment is shorter than two seconds."""
    labels = [label for label, _, _ in session.truth.segments]
    assert (labels[0], labels[-1]) == ("t-pose", "still")
    assert set(labels) <= {"t-pose", "still", *PLAYED}
    assert min(end - start for _, start, end in session.truth.segments) >= 2 * RATE


def test_a_session_is_the_same_bytes_each_time(session):
    """Made anew, it is the same file."""
    assert long_session(QUICK) == session


def test_the_long_session_is_long():
    """72,000 frames: at least 100 segments of 15 motions, each motion more than once, dead time and retakes."""
    parts = schedule(72_000, np.random.default_rng(1))
    labels = [part.motion.name for part in parts]
    assert sum(part.frames for part in parts) == 72_000
    assert len(labels) >= 100
    assert sum(labels.count(label) > 1 for label in PLAYED) >= 15
    retakes = [a for a, b, c in zip(labels, labels[1:], labels[2:], strict=False) if b == "still" and a == c]
    assert len(retakes) >= 5
    assert labels.count("still") >= 20


@pytest.mark.parametrize("name", FIGURES)
def test_the_default_method_finds_what_a_figure_performs(name):
    """Told the number of motions, it labels at least 95 % of the frames as the truth does."""
    truth = figure(name).truth
    numbers = {label: number for number, (label, _, _) in enumerate(truth.segments)}
    true = np.concatenate([np.full(end - start, numbers[label]) for label, start, end in truth.segments])
    found = segment(opened(figure(name).glb), Parameters(motions=len(numbers)), threads=2)
    assert frame_accuracy(found.labels, true) >= 0.95
