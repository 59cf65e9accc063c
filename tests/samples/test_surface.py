"""The figures' surface: closed, smooth, and where the limbs say."""

import numpy as np

from caesura.samples.surface import Limb, skin

BALL = Limb(0, np.zeros(3), np.zeros(3), 0.5, 0.5)
CONE = Limb(0, np.zeros(3), np.array([1.0, 0.0, 0.0]), 0.2, 0.1)


def edges(triangles):
    """Every undirected edge, and how many triangles share it."""
    all_edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(all_edges, axis=1), axis=0, return_counts=True)


def volume(vertices, triangles):
    """The volume that a closed surface holds, positive where triangles run counter-clockwise from outside."""
    a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
    return (a * np.cross(b, c)).sum() / 6


def test_a_ball_becomes_a_sphere():
    """Every vertex of a ball's surface lies on it, with its normal along the radius, and the volume is the ball's."""
    surface = skin([BALL], 0.06)
    radius = np.linalg.norm(surface.vertices, axis=1)
    assert np.allclose(radius, 0.5, atol=1e-6)
    assert np.allclose(surface.normals, surface.vertices / radius[:, None], atol=1e-4)
    assert np.isclose(volume(surface.vertices, surface.triangles), 4 / 3 * np.pi * 0.5**3, rtol=0.02)


def test_the_surface_is_one_closed_piece():
    """Two triangles meet at every edge, and V - E + F = 2: one welded surface without holes or handles."""
    arm = Limb(1, np.array([1.0, 0.0, 0.0]), np.array([1.0, 0.8, 0.0]), 0.12, 0.08)
    surface = skin([CONE, arm], 0.04)
    pairs, shared = edges(surface.triangles)
    assert (shared == 2).all()
    assert len(surface.vertices) - len(pairs) + len(surface.triangles) == 2


def test_a_round_cone_is_as_thick_as_its_ends():
    """The distance to a round cone is that to its axis less a radius that changes evenly along it."""
    points = np.array([[0.0, 0.5, 0.0], [0.5, 0.0, 0.5], [1.5, 0.0, 0.0], [0.0, 0.0, 0.0]])
    assert np.allclose(CONE.distance(points), [0.3, 0.35, 0.4, -0.2])


def test_triangles_are_of_one_size():
    """Edges keep to about the length asked for, so that no region counts for much more than another."""
    surface = skin([CONE], 0.03)
    pairs, _ = edges(surface.triangles)
    length = np.linalg.norm(surface.vertices[pairs[:, 0]] - surface.vertices[pairs[:, 1]], axis=1)
    assert 0.02 < np.median(length) < 0.04
    assert length.max() < 0.08
