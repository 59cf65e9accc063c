"""Heat kernel signatures: what leaves them as they are, and how near the few functions come to all."""

import numpy as np
import pytest

from caesura.core.descriptors import heat_kernel
from caesura.core.descriptors.heat_kernel import HeatKernel
from caesura.core.errors import LimitExceeded
from caesura.core.mesh.laplacian import DENSE, Laplacian
from tests import oracles
from tests.animations import bar, performing_bar, turned
from tests.core.mesh.shapes import mesh, rolled, sheet, values


def exact(place, triangles, times):
    """(T, times): the mean over the corners of the signature from every eigenfunction."""
    return oracles.heat_kernel_signature(place, triangles, times)[triangles].mean(axis=1)


def test_at_rest_the_signature_is_that_of_all_eigenfunctions():
    """The functions left out are cold at the shortest time."""
    rest, triangles = bar(rings=20)
    surface = HeatKernel.of(mesh(rest, triangles))
    np.testing.assert_allclose(surface.at_rest[:, :, 0], exact(rest, triangles, surface.pieces[0].times), rtol=5e-3)


def test_in_a_pose_it_is_nearly_so():
    """The functions of the rest shape are not quite those of the pose: the change agrees to a fifth of the largest."""
    source = performing_bar([0, 2], seconds=1.0, rings=20).animation
    surface = HeatKernel.of(mesh(source.rest, source.triangles))
    vertices, times = source.vertices(0, 60)[4::11], surface.pieces[0].times
    at_rest = np.log(exact(source.rest, source.triangles, times))
    now = np.stack([np.log(exact(place, source.triangles, times)) for place in vertices])
    expected = np.sqrt(np.mean((now - at_rest) ** 2, axis=2))
    found = values(surface, vertices)
    assert np.abs(found - expected).max() < expected.max() / 5
    assert np.corrcoef(found.ravel(), expected.ravel())[0, 1] > 0.98


@pytest.mark.parametrize("angle", [0.05, 0.3])
def test_bending_that_stretches_nothing_changes_nothing(angle):
    """A sheet rolled up conducts heat as when it was flat."""
    place, triangles = sheet()
    assert values(HeatKernel.of(mesh(place, triangles)), rolled(place, angle)[None]).max() < 1e-5


def test_rigid_motion_changes_nothing():
    """Turned and moved."""
    rest, triangles = bar()
    moved = np.stack([turned(rest.astype(np.float64), a) + 3 for a in np.linspace(0, 6, 12)])
    surface = HeatKernel.of(mesh(rest, triangles))
    assert (values(surface, moved) <= surface.noise(float(np.abs(moved).max()))).all()


def test_each_piece_keeps_its_heat():
    """Two sheets apart, of which one is stretched: the other does not change."""
    place, triangles = sheet()
    two = np.concatenate([place, place + np.float32([0, 0, 5])])
    surface = HeatKernel.of(mesh(two, np.concatenate([triangles, triangles + len(place)])))
    stretched = two.copy()
    stretched[len(place) :, 0] *= 1.5
    first, second = np.split(values(surface, stretched[None])[0], 2)
    assert first.max() < 1e-6
    assert second.min() > 0.01


def test_what_collapses_stays_finite():
    """A triangle alone, a frame in which all points meet, and one far away."""
    for place, triangles in (sheet(), (np.eye(3, dtype=np.float32), np.array([[0, 1, 2]]))):
        surface = HeatKernel.of(mesh(place, triangles))
        assert np.isfinite(values(surface, np.stack([0 * place, place * np.float32(1e12), place - 7]))).all()


def test_many_points_have_the_functions_that_few_have():
    """Beyond `DENSE` points they come from another solver."""
    place, triangles = sheet(columns=30, rows=20)
    assert len(place) > DENSE
    laplacian = Laplacian.of(triangles, len(place))
    weights, areas = laplacian.at(place.astype(np.float64)[:, :, None])
    few, modes = laplacian.smoothest_functions(weights[:, 0], areas[:, 0], 12)
    np.testing.assert_allclose(few[1], (np.pi / 29) ** 2, rtol=0.01)  # half a wave along a sheet of length 29
    np.testing.assert_allclose(modes.T @ (areas * modes), np.eye(12), atol=1e-8)
    again, same = laplacian.smoothest_functions(weights[:, 0], areas[:, 0], 12)
    np.testing.assert_array_equal(few, again)
    np.testing.assert_array_equal(modes, same)


def test_a_mesh_too_large_is_refused(monkeypatch):
    """And the refusal says what to choose in its place."""
    monkeypatch.setattr(heat_kernel, "MOST_POINTS", 50)
    with pytest.raises(LimitExceeded, match="geodesic") as refused:
        HeatKernel.of(mesh(*sheet()))
    assert refused.value.where == {"limit": 50, "actual": 60}
