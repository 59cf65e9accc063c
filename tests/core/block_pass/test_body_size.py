"""The size of the body, taken out: what only grows and shrinks is at rest, by every descriptor and for every method."""

import numpy as np
import pytest
from scipy.sparse.csgraph import minimum_spanning_tree
from scipy.spatial.distance import pdist, squareform

from caesura.core.agreement import frame_accuracy
from caesura.core.block_pass.body_size import _shortest_tree, scale_to_rest_size
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut, segment
from caesura.core.registry.descriptors import DESCRIPTORS
from caesura.core.registry.methods import METHODS
from tests.animations import animation, bar, performing_bar, turned

FRAMES = 120


def pulses(frames=FRAMES):
    """A size that swings in one half of the take as it does not in the other."""
    time = np.arange(frames) / 30
    return np.where(time < 2, 1 + 0.3 * np.sin(2 * np.pi * time), 1.6 + 0.1 * np.sin(9 * time))


def pulsing(rest, triangles, frames=FRAMES):
    """A body of constant shape that turns, moves, and swells."""
    shape = rest.astype(np.float64)
    moved = [size * turned(shape, 0.01 * f) + 0.02 * f for f, size in enumerate(pulses(frames))]
    return animation(np.stack(moved), triangles, rest=rest)


@pytest.mark.parametrize("descriptor", DESCRIPTORS)
def test_a_pulsing_body_of_constant_shape_does_not_deform_by_any_descriptor(descriptor):
    """No feature has a column, and the result says that nothing deforms; without the choice, something does."""
    source = pulsing(*bar(rings=12), frames=60)
    for curvature in ("gaussian", "mean") if descriptor == "curvature" else ("gaussian",):
        chosen = {"descriptors": descriptor, "curvature": curvature}
        found = analyse(source, Parameters(**chosen, scale_invariant=True))
        assert [feature.values.shape[1] for feature in found.features] == [0] * len(found.features)
        assert "no-deformation" in {notice.code for notice in found.notices}
        plain = analyse(source, Parameters(**chosen))
        assert any(feature.values.shape[1] for feature in plain.features)


@pytest.mark.parametrize("kind", ["mesh", "skeleton"])
@pytest.mark.parametrize("motions", [3, "auto"])
def test_a_pulsing_body_of_constant_shape_is_one_segment_by_every_method(kind, motions):
    """Of triangles, and of joints alone."""
    rest, triangles = bar(rings=12)
    source = pulsing(rest, triangles if kind == "mesh" else [])
    analysis = analyse(source, Parameters(scale_invariant=True))
    for method in METHODS:
        if motions == "auto" and METHODS[method].needs_motions:
            continue
        assert len(cut(analysis, Parameters(method=method, motions=motions)).segments) == 1, method


def test_what_deforms_and_pulses_is_cut_as_what_deforms():
    """The same cuts, whatever the size does meanwhile."""
    performance = performing_bar([0, 1, 2], seconds=3.0, rings=12)
    source = performance.animation
    vertices = source.vertices(0, source.frames) * pulses(source.frames)[:, None, None]
    larger = animation(vertices, source.triangles, rest=source.rest)
    parameters = Parameters(scale_invariant=True, motions=3)
    plain, found = segment(source, parameters), segment(larger, parameters)
    assert frame_accuracy(found.labels, performance.truth) > 0.95
    assert np.abs(found.cuts - plain.cuts).max() <= 2


def test_a_body_that_has_no_size_is_drawn_as_it_is():
    """All points in one place, in a frame or at rest."""
    rest, triangles = bar(rings=4)
    vertices = np.stack([rest, 0 * rest, 3 * rest])
    found = scale_to_rest_size(animation(vertices, triangles, rest=rest), rest).vertices(0, 3)
    np.testing.assert_allclose(found, np.stack([rest, 0 * rest, rest]), atol=1e-6)
    same = animation(vertices, triangles, rest=0 * rest)
    assert scale_to_rest_size(same, 0 * rest) is same


@pytest.mark.parametrize("joints", [2, 3, 40])
def test_the_tree_of_a_skeleton_is_the_shortest(joints):
    """As long as SciPy's, and joins all joints."""
    place = np.random.default_rng(joints).normal(size=(joints, 3)).astype(np.float32)
    lines = _shortest_tree(place)
    length = np.linalg.norm(place[lines[:, 0]].astype(float) - place[lines[:, 1]], axis=1).sum()
    assert length == pytest.approx(minimum_spanning_tree(squareform(pdist(place.astype(float)))).sum())
    assert len(lines) == joints - 1
    assert set(lines.ravel().tolist()) == set(range(joints))
