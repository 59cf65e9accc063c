"""The paper's figures on stand-ins: what its text says of them is so here too."""

import numpy as np
import pytest

from benchmarks.paper.pictures import opposite_strains
from benchmarks.paper.stand_ins import exercise
from caesura.api import open_animation
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, segment
from caesura.samples.morphing_face import ORDER, build_face


def test_entropy_shows_what_the_sum_of_strains_hides():
    """Figure 8: two halves of a body deform towards each other; the sum stays, the energy does not."""
    energy, total = opposite_strains()
    assert np.ptp(total) < 1e-9 * total[0]
    assert np.nanmax(energy) > 2 * np.nanmin(energy)


@pytest.fixture(scope="module")
def face():
    """Nine expressions in half of the paper's time."""
    return build_face(540)


def test_a_face_has_a_key_frame_for_each_of_nine_expressions(face):
    """As in figure 1: each within a second of where the expression is strongest."""
    source = open_animation(face.vertices, face.triangles, rest_shape=face.rest)
    parameters = Parameters(method="joint-entropy", motions=7, window_seconds=0.5, keyframe_window_seconds=1.0)
    found = segment(source, parameters)
    assert len(face.peaks) == len(ORDER) == 9
    assert len(found.key_frames) == 9
    assert np.abs(found.key_frames - np.array(face.peaks)).max() <= 30


def test_the_curve_of_windows_has_less_noise_than_that_of_neighbours(face):
    """As in figure 1: fewer local maxima by far."""
    source = open_animation(face.vertices, face.triangles, rest_shape=face.rest)
    windows, neighbours = (
        len(analyse(source, Parameters(window_seconds=0.5, energy=energy)).peaks) for energy in ("modified", "joint")
    )
    assert 2 * windows < neighbours


def test_squats_and_jumps_are_two_motions():
    """As in figure 3, at five frames a second."""
    take = exercise()
    found = segment(take.animation, take.parameters())
    assert found.motions == 2
    assert len(found.cuts) == 1
    assert np.mean(found.labels == take.truth) > 0.9
    assert len(found.variances) == 1
