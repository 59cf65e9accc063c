"""Other recordings of one take, and other bodies that carry one motion."""

import numpy as np
import pytest

from benchmarks.takes.captured_bodies import larger, on_other_bodies, read_captured
from benchmarks.takes.recordings import MARKERS, Recording, recorded_otherwise
from caesura.api import open_animation

NAME = "13_30_30fps.bvh"


@pytest.fixture
def captured(shared):
    """A captured take, where the shared data is."""
    return shared / "data" / "real" / "performed" / NAME


def test_bones_begin_and_end_where_the_reader_has_its_joints(captured):
    """To a hundredth of a millimetre; the reader lists joints in another order."""
    animation = open_animation(captured)
    read = np.array(animation.vertices(0, animation.frames))
    bodies = dict(on_other_bodies(captured))
    skeleton, motion, rate = read_captured(captured)
    _, starts = skeleton.pose(motion, len(motion["root"]))
    assert rate == animation.frame_rate
    apart = np.linalg.norm(read[::100, None] / 100 - starts[::100, :, None], axis=3)
    assert apart.max(axis=0).min(axis=1).max() < 1e-5
    assert bodies["on a larger body"].vertices.shape == read.shape


def test_a_larger_body_has_longer_limbs_above_all(captured):
    """By a third, the rest by a seventh; its motion stays."""
    skeleton, _, _ = read_captured(captured)
    grown = larger(skeleton)
    share = [
        np.linalg.norm(b.vector) / np.linalg.norm(a.vector)
        for a, b in zip(skeleton.bones, grown.bones, strict=True)
        if a.vector.any()
    ]
    assert (min(share), max(share)) == (pytest.approx(1.15), pytest.approx(1.35))


def test_a_recording_keeps_what_the_body_does():
    """Turned, mirrored and in centimetres, distances are what they were; markers are points of the body."""
    points = np.random.default_rng(3).normal(size=(60, 80, 3))
    take, changes = Recording(points, np.array([[0, 1, 2]]), 30.0), recorded_otherwise()
    between = np.linalg.norm(points[:, 0] - points[:, 1], axis=1)
    for name, scale in (("turned", 1), ("mirrored", 1), ("in centimetres", 100)):
        other = changes[name](take).vertices
        np.testing.assert_allclose(np.linalg.norm(other[:, 0] - other[:, 1], axis=1), scale * between)
    markers = changes["as markers"](take)
    assert markers.triangles is None
    assert markers.vertices.shape == (60, MARKERS, 3)
    assert np.isin(markers.vertices, points).all()
    assert changes["60 frames a second"](take).vertices[::2] == pytest.approx(points[:60])
