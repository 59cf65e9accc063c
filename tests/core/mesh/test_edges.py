"""Takes at the edge of what can be cut: a named error or one honest segment, by every method that finds K itself."""

import numpy as np
import pytest

from caesura.core.errors import InvalidModel
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from tests.animations import animation, bar

METHODS = ("switching", "joint-entropy")


def moving(frames):
    """A bar that swings."""
    rest, triangles = bar(rings=6)
    swing = np.sin(np.arange(frames) / 4)[:, None, None]
    bent = np.zeros((frames, *rest.shape)) + rest
    bent[..., 1:2] += swing * rest[:, :1] ** 2
    return bent, triangles


@pytest.mark.parametrize("method", METHODS)
def test_a_value_that_is_no_number_is_refused(method):
    """By frame and vertex."""
    vertices, triangles = moving(40)
    vertices[7, 3, 1] = np.nan
    with pytest.raises(InvalidModel) as refused:
        segment(animation(vertices, triangles), Parameters(method=method))
    assert refused.value.code == "non-finite-data"


@pytest.mark.parametrize("method", METHODS)
def test_one_frame_is_refused(method):
    """Nothing moves in it."""
    with pytest.raises(InvalidModel) as refused:
        segment(animation(*moving(1)), Parameters(method=method))
    assert refused.value.code == "no-motion"


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("motions", ["auto", 1000])
@pytest.mark.parametrize("frames", [2, 20])
def test_a_few_frames_are_cut(method, motions, frames):
    """Into segments that tile them, never more motions than frames; too many asked for are said to be too many."""
    found = segment(animation(*moving(frames)), Parameters(method=method, motions=motions))
    assert found.segments[0].start == 0
    assert found.segments[-1].end == frames
    assert found.motions <= frames
    assert motions != 1000 or {n.code for n in found.notices} & {"fewer-motions", "no-key-frames"}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("motions", ["auto", 3])
def test_what_never_moves_is_one_segment_performed_once(method, motions):
    """And it is said that nothing deforms."""
    rest, triangles = bar(rings=6)
    found = segment(animation(np.repeat(rest[None], 90, axis=0), triangles), Parameters(method=method, motions=motions))
    assert len(found.segments) == 1
    assert len(found.segments[0].repeats) == 1
    assert "no-deformation" in {notice.code for notice in found.notices}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("motions", ["auto", 2])
def test_one_triangle_is_cut(method, motions):
    """A single triangle whose corner swings."""
    corner = np.zeros((120, 3, 3)) + np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    corner[:, 2, 0] += 0.4 * np.sin(np.arange(120) / 5)
    found = segment(animation(corner, [[0, 1, 2]]), Parameters(method=method, motions=motions))
    assert found.segments[-1].end == 120
