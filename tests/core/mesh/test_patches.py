"""Patches: coherent, about equal, and every triangle in one."""

import numpy as np
import pytest

from caesura.core.mesh.patches import assign_patches
from tests.animations import bar


def areas(rest, triangles):
    corner = rest[triangles]
    return np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2


def test_patches_are_about_equal():
    """Of 64 patches of a tube the largest has at most four times the mean area, the smallest a quarter of it."""
    rest, triangles = bar(rings=200, around=24)
    patch = assign_patches(rest, triangles, 64)
    area = np.bincount(patch, areas(rest, triangles))
    assert len(area) == 64
    assert area.max() < 4 * area.mean()
    assert area.min() > area.mean() / 4


def test_a_patch_is_a_small_piece():
    """No two triangles of a patch are farther apart than a few patch widths."""
    rest, triangles = bar(rings=200, around=24)
    patch, centre = assign_patches(rest, triangles, 64), rest[triangles].mean(axis=1)
    assert max(np.ptp(centre[patch == p], axis=0).max() for p in range(64)) < 0.12


def test_few_triangles_are_a_patch_each():
    """A mesh of fewer triangles than patches: one each."""
    rest, triangles = bar(rings=4)
    assert len(np.unique(assign_patches(rest, triangles, 256))) == len(triangles)


def test_triangles_without_area_lie_anywhere_and_own_no_patch():
    """Half the triangles are points: every patch still has area."""
    rest, triangles = bar()
    points = np.repeat(np.arange(len(triangles))[:, None] % len(rest), 3, axis=1)
    both = np.concatenate([points, triangles])
    patch = assign_patches(rest, both, 32)
    assert len(patch) == len(both)
    assert (np.bincount(patch, areas(rest, both), minlength=32) > 0).all()


@pytest.mark.parametrize("triangles", [np.zeros((0, 3), np.int64), np.zeros((4, 3), np.int64)])
def test_nothing_to_divide(triangles):
    """No triangles, or none with area: none, or one patch."""
    assert assign_patches(np.ones((1, 3), np.float32), triangles).tolist() == [0] * len(triangles)
