"""The order of triangles in memory."""

import numpy as np

from caesura.core.mesh.triangle_order import order_triangles
from tests.animations import bar


def test_every_triangle_comes_once_and_tiles_share_few_vertices():
    """However the file orders them: a tile needs little more than one vertex for two triangles."""
    rest, triangles = bar(rings=300)
    triangles = np.random.default_rng(0).permutation(triangles)
    order = order_triangles(rest, triangles, 512)
    np.testing.assert_array_equal(np.sort(order), np.arange(len(triangles)))
    tiles = [triangles[order[i : i + 512]] for i in range(0, len(order) - 511, 512)]
    assert max(len(np.unique(tile)) for tile in tiles) < 0.6 * 512


def test_triangles_in_one_place_are_ordered_all_the_same():
    """Coinciding centres and no triangles at all."""
    assert order_triangles(np.zeros((3, 3)), np.tile([0, 1, 2], (300, 1)), 128).tolist() == list(range(300))
    assert order_triangles(np.zeros((3, 3)), np.zeros((0, 3), int), 128).size == 0
