"""Curvature: spheres, flat and rolled sheets, a slow twin."""

import numpy as np
import pytest
import trimesh

from caesura.core.descriptors.curvature import Curvature
from caesura.core.mesh.angles import AngleDefect, FoldAngles
from caesura.core.mesh.edges import find_hinges
from tests import oracles
from tests.animations import bar, performing_bar, turned
from tests.core.mesh.shapes import mesh, rolled, sheet, values

KINDS = ("gaussian", "mean")


@pytest.mark.parametrize("radius", [0.5, 2.0])
def test_a_sphere_is_curved_by_its_radius(radius):
    """Gaussian curvature 1 / r² and mean curvature 1 / r at every point, and 4π in all."""
    ball = trimesh.creation.icosphere(subdivisions=4, radius=radius)
    sphere = mesh(ball.vertices, np.asarray(ball.faces, np.int64))
    defect = AngleDefect.of(sphere).total(sphere.rows_at_rest())[:, 0]
    folds = FoldAngles(find_hinges(sphere.corners)).total(sphere.rows_at_rest())[:, 0]
    six = np.bincount(sphere.corners.ravel()) == 6  # at the twelve others a third of the triangles is no fair share
    np.testing.assert_allclose((defect / sphere.cells())[six], radius**-2, rtol=0.06)
    np.testing.assert_allclose((folds / sphere.cells())[six], 1 / radius, rtol=0.06)
    assert defect.sum(dtype=np.float64) == pytest.approx(4 * np.pi, rel=1e-4)
    np.testing.assert_allclose(defect, ball.vertex_defects, atol=1e-5)
    assert folds.sum(dtype=np.float64) == pytest.approx(4 * np.pi * radius, rel=2e-3)


def test_a_flat_sheet_has_no_curvature():
    """Neither kind, at any point inside."""
    flat = mesh(*sheet())
    inside = (flat.rest[:, :2] > 0).all(axis=1) & (flat.rest[:, :2] < flat.rest[:, :2].max(axis=0)).all(axis=1)
    np.testing.assert_allclose(AngleDefect.of(flat).total(flat.rows_at_rest())[inside], 0, atol=2e-6)
    np.testing.assert_allclose(FoldAngles(find_hinges(flat.corners)).total(flat.rows_at_rest()), 0, atol=1e-6)


def test_rolling_a_sheet_changes_its_mean_curvature_alone():
    """A cylinder of radius r has mean curvature 1 / 2r and no other; here r is 10."""
    place, triangles = sheet(columns=20, rows=9)
    roll = rolled(place, 0.1)[None]
    assert values(Curvature.of(mesh(place, triangles)), roll).max() < 1e-5
    found = values(Curvature.of(mesh(place, triangles), "mean"), roll)[0]
    middle = np.abs(place[triangles].mean(axis=1) - np.float32([9.5, 4, 0])).max(axis=1) < 3
    # times the root of the area of three cells, each of area 1
    np.testing.assert_allclose(found[middle], 0.05 * np.sqrt(3), rtol=1e-4)


@pytest.mark.parametrize("kind", KINDS)
def test_curvature_agrees_with_plain_loops(kind):
    """On a bar that bends and swells, frame by frame."""
    source = performing_bar([0, 3], seconds=0.2, rings=8).animation
    vertices = source.vertices(0, source.frames)
    found = values(Curvature.of(mesh(source.rest, source.triangles), kind), vertices)
    np.testing.assert_allclose(found, oracles.curvature(vertices, source.rest, source.triangles, kind), atol=2e-4)


@pytest.mark.parametrize("kind", KINDS)
def test_rigid_motion_does_not_change_curvature(kind):
    """Nor does size the Gaussian, whose totals are angles."""
    rest, triangles = bar()
    moved = np.stack([turned(rest.astype(np.float64), a) + 3 for a in np.linspace(0, 6, 12)])
    surface = Curvature.of(mesh(rest, triangles), kind)
    assert (values(surface, moved) <= surface.noise(float(np.abs(moved).max()))).all()
    if kind == "gaussian":
        assert values(surface, 2.5 * moved).max() < 1e-3
