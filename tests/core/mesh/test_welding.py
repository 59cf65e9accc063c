"""Welding: copies of a point are one again, and parts that only touch stay two."""

import numpy as np

from caesura.core.mesh.welding import find_same_points, weld_vertices
from tests.animations import animation, bar, turned
from tests.core.mesh.shapes import in_pieces


def test_copies_of_a_point_are_one():
    """A bar in separate triangles has as many points as the bar."""
    rest, triangles = bar()
    moving = np.stack([turned(rest, 0.1 * t) for t in range(20)])
    loose, apart, frames = in_pieces(triangles, rest, moving)
    same = weld_vertices(animation(frames, loose, rest=apart), apart)
    assert len(np.unique(same)) == len(rest)
    np.testing.assert_array_equal(apart[same], apart)
    assert (same <= np.arange(len(same))).all()


def test_parts_that_touch_and_part_are_two():
    """Two points at one place at rest, of which one leaves, and a third that goes with it."""
    rest = np.zeros((4, 3), np.float32)
    looks = np.zeros((2, 4, 3), np.float32)
    looks[1, [1, 3]] = 1
    assert find_same_points(rest, looks).tolist() == [0, 1, 0, 1]


def test_rounding_does_not_part_copies():
    """Nor does the sign of zero."""
    rest = np.array([[0.0, 1, 2], [-0.0, 1, 2], [5, 5, 5]], np.float32)
    looks = rest[None] + np.float32([[[0, 0, 0], [4e-6, 0, 0], [0, 0, 0]]])
    assert find_same_points(rest, looks).tolist() == [0, 0, 2]


def test_points_that_are_near_are_not_one():
    """Only the same place is the same point."""
    rest = np.array([[1, 0, 0], [1 + 1e-6, 0, 0]], np.float32)
    assert find_same_points(rest, rest[None]).tolist() == [0, 1]
