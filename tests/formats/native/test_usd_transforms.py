"""Matrices of a USD as translation, rotation and scale, whatever they are."""

import numpy as np

from caesura.formats.native.usd.transforms import decompose


def test_matrices_that_turn_nothing_have_a_rotation() -> None:
    """Axes in a plane, of no length, and of a length that no number holds."""
    found = np.tile(np.eye(4), (5, 1, 1))
    found[1, :3, :3] = 0
    found[2, :3, :3] = [[1, 0, 0], [1, 0, 0], [0, 0, 1]]
    found[3, :3, :3] *= 1e200
    found[4, 1, 1] = -2
    with np.errstate(all="ignore"):
        places = decompose(found)
    np.testing.assert_allclose(np.linalg.norm(places.rotation, axis=1), 1)
    assert places.sheared
    np.testing.assert_allclose(places.scale[4], [-1, 2, 1])
