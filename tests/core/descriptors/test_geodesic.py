"""Geodesic distance: strips, rolled sheets, paths found by plain loops."""

import numpy as np
import pytest

from caesura.core.descriptors.geodesic import SOURCES, Geodesic
from caesura.core.mesh.edge_graph import EdgeGraph
from tests import oracles
from tests.animations import bar, performing_bar, turned
from tests.core.mesh.shapes import mesh, rolled, sheet, values


def test_along_a_flat_strip_the_distance_is_euclids():
    """From its first corner to every point of the same side."""
    strip = mesh(*sheet(columns=30, rows=2))
    side = strip.rest[:, 1] == 0
    np.testing.assert_allclose(EdgeGraph.of(strip).from_nearest(np.array([0]))[side], np.arange(30))


def test_paths_are_the_shortest_in_every_frame():
    """The averages, against all paths between all points, of poses that are far from rest."""
    source = performing_bar([0, 2], seconds=1.0, rings=16).animation
    surface = Geodesic.of(mesh(source.rest, source.triangles))
    vertices = source.vertices(0, 60)[::7]
    found = surface.average(vertices)
    for frame, place in enumerate(vertices):
        lengths = oracles.path_lengths(place, source.triangles)
        expected = sum(lengths[s.seeds[0]] * s.share for s in surface.sources)
        np.testing.assert_allclose(found[:, frame], expected, rtol=1e-5)


def test_a_few_sources_speak_for_all_points():
    """The change of the average over the sources follows that over the whole surface."""
    source = performing_bar([0, 2], seconds=1.0, rings=16).animation
    body = mesh(source.rest, source.triangles)
    vertices = source.vertices(15, 16)
    weight = body.cells() / body.cells().sum()
    all_points = [oracles.path_lengths(place, source.triangles) @ weight for place in (source.rest, vertices[0])]
    mean = [average[source.triangles].mean(axis=1) for average in all_points]
    expected = np.abs(np.log(mean[1] / mean[0]))
    found = values(Geodesic.of(body), vertices)[0]
    assert np.abs(found - expected).max() < 0.1 * expected.max()


@pytest.mark.parametrize("angle", [0.05, 0.3])
def test_bending_that_stretches_nothing_changes_nothing(angle):
    """A sheet rolled up is as far from itself as flat."""
    place, triangles = sheet()
    surface = Geodesic.of(mesh(place, triangles))
    assert values(surface, rolled(place, angle)[None]).max() < 1e-5


def test_rigid_motion_changes_nothing_and_size_its_logarithm():
    """Whatever the angle."""
    rest, triangles = bar()
    moved = np.stack([turned(rest.astype(np.float64), a) + 3 for a in np.linspace(0, 6, 12)])
    surface = Geodesic.of(mesh(rest, triangles))
    assert (values(surface, moved) <= surface.noise(float(np.abs(moved).max()))).all()
    np.testing.assert_allclose(values(surface, 2 * moved), np.log(2), atol=1e-4)


def test_each_piece_has_its_own_average():
    """Two sheets apart, of which one grows: the other does not change, and nothing is infinite."""
    place, triangles = sheet()
    two = np.concatenate([place, place + np.float32([0, 0, 5])])
    surface = Geodesic.of(mesh(two, np.concatenate([triangles, triangles + len(place)])))
    grown = two.copy()
    grown[len(place) :] *= 2
    first, second = np.split(values(surface, grown[None])[0], 2)
    np.testing.assert_allclose(first, 0, atol=1e-6)
    np.testing.assert_allclose(second, np.log(2), atol=1e-5)


def test_a_single_triangle_has_fewer_sources_than_asked_for():
    """Three points, three sources."""
    surface = Geodesic.of(mesh(np.eye(3), np.array([[0, 1, 2]])))
    assert len(surface.sources) == 3 < SOURCES
    np.testing.assert_allclose(values(surface, np.zeros((1, 3, 3))), np.log(1000), rtol=1e-4)
