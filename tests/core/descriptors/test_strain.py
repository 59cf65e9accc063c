"""Strain of triangles: analytic answers, a slow twin, and what must not change it."""

import numpy as np
import pytest

from caesura.core.descriptors.strain import TriangleStrain
from caesura.core.kernels.descriptors import TILE
from tests import oracles
from tests.animations import bar, turned

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], np.float32)
HALVES = np.array([[0, 1, 2], [1, 3, 2]])


def strains(vertices, rest, triangles, **options):
    """(frames, T) in the order of `triangles`."""
    made = TriangleStrain.of(rest, triangles, np.arange(len(triangles)), **options)
    tiles = [tile.T.copy() for _, tile in made.tiles(np.ascontiguousarray(vertices, np.float32))]
    return np.concatenate(tiles, axis=1)


@pytest.mark.parametrize("s", [0.25, 0.5, 0.999, 1.001, 2.0, 7.0])
def test_a_uniform_stretch_has_log_strain_ln_s_times_the_root_of_two(s):
    """Both principal stretches are s, so the strain is |ln s| √2; Biot's is |s − 1| √2, the largest |s − 1|."""
    expected = {"log": abs(np.log(s)) * np.sqrt(2), "biot": abs(s - 1) * np.sqrt(2), "max": abs(s - 1)}
    for measure, value in expected.items():
        found = strains(s * SQUARE[None], SQUARE, HALVES, measure=measure)
        np.testing.assert_allclose(found, value, rtol=2e-5, atol=2e-7)


def test_a_stretch_along_one_axis_strains_by_its_logarithm_alone():
    """The other principal stretch is 1."""
    moved = SQUARE * np.float32([1.5, 1, 1])
    np.testing.assert_allclose(strains(moved[None], SQUARE, HALVES), np.log(1.5), rtol=1e-6)


@pytest.mark.parametrize("k", [0.01, 0.5, 3.0])
def test_a_pure_shear_strains_by_the_golden_pair_of_stretches(k):
    """x + k y has stretches σ and 1/σ with σ = k/2 + √(1 + k²/4), so log strain is √2 ln σ."""
    moved = SQUARE.copy()
    moved[:, 0] += np.float32(k) * SQUARE[:, 1]
    sigma = k / 2 + np.sqrt(1 + k * k / 4)
    np.testing.assert_allclose(strains(moved[None], SQUARE, HALVES), np.sqrt(2) * np.log(sigma), rtol=2e-5)


@pytest.mark.parametrize("measure", ["log", "biot", "max"])
def test_strain_agrees_with_singular_values_in_float64(measure):
    """Arbitrary deformations of a mesh of several tiles, against the slow twin on the same float32 vertices."""
    rest, triangles = bar(rings=80)
    draw = np.random.default_rng(1)
    affine = np.eye(3) + 0.3 * draw.normal(size=(12, 3, 3))
    moved = (rest @ affine + 0.01 * draw.normal(size=(12, *rest.shape))).astype(np.float32)
    expected = oracles.strain(moved, rest, triangles, measure)
    assert len(triangles) > TILE
    error = np.abs(strains(moved, rest, triangles, measure=measure) - expected) / np.percentile(expected, 99.9)
    assert np.percentile(error, 99.99) <= 1e-4
    assert error.max() <= 1e-3


@pytest.mark.parametrize("far", [0.0, 10.0])
def test_a_rigid_motion_does_not_strain(far):
    """At any angle, and ten body lengths away, only the rounding of the float32 vertices is left."""
    rest, triangles = bar()
    moved = np.stack([turned(rest.astype(np.float64), a) + far for a in np.linspace(0, 6, 40)]).astype(np.float32)
    made = TriangleStrain.of(rest, triangles, np.arange(len(triangles)))
    noise = made.noise(float(np.abs(moved).max()))
    found = strains(moved, rest, triangles)
    assert (found <= noise).all()
    assert found.max() < (5e-5 if far == 0 else 5e-4)


def test_a_sliver_keeps_its_digits():
    """A triangle a thousand times longer than high, turned and stretched, is as exact as its corners allow."""
    rest = np.array([[0, 0, 0], [1, 0, 0], [0.5, 0.001, 0]], np.float32)
    moved = np.stack([turned(1.2 * rest.astype(np.float64), a) for a in np.arange(50)]).astype(np.float32)
    expected = oracles.strain(moved, rest, [[0, 1, 2]])
    np.testing.assert_allclose(strains(moved, rest, np.array([[0, 1, 2]])), expected, atol=2e-4)


def test_the_order_of_the_corners_does_not_matter():
    """Strain knows neither orientation nor first corner."""
    rest, triangles = bar()
    moved = (rest * np.float32([1.1, 0.7, 1.3]) + 0.01 * np.sin(9 * rest[:, ::-1]))[None]
    first = strains(moved, rest, triangles)
    for turn in ([1, 2, 0], [2, 0, 1], [1, 0, 2]):
        np.testing.assert_array_equal(strains(moved, rest, triangles[:, turn]), first)


def test_triangles_without_area_take_no_part():
    """Coinciding and collinear corners are left out, however they lie in space."""
    rest = np.array([[1, 1, 1], [2, 3, 4], [4, 2, 1], [3, 5, 7]], np.float32) / 7
    triangles = np.array([[0, 0, 1], [0, 1, 2], [0, 1, 3], [2, 2, 2]])
    made = TriangleStrain.of(rest, triangles, np.arange(4))
    assert (made.columns, made.left_out, made.triangles.tolist()) == (1, 3, [1])


def test_a_collapsed_triangle_is_strained_by_a_finite_amount():
    """All corners in one place: both stretches count as a thousandth."""
    found = strains(np.zeros((1, 4, 3)), SQUARE, HALVES)
    np.testing.assert_allclose(found, np.sqrt(2) * np.log(1000), rtol=1e-5)
