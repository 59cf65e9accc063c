"""A heavy mesh is drawn lighter, and what moves apart stays apart."""

import numpy as np

from caesura.formats.playback.decimation import decimate_mesh


def sheet(n: int, height: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """A square of n x n vertices."""
    x, z = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    place = np.stack([x, np.full_like(x, height), z], axis=-1).reshape(-1, 3).astype(np.float32)
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = i[:-1, :-1].ravel(), i[:-1, 1:].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel()
    return place, np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])


def test_a_light_mesh_is_drawn_as_it_is() -> None:
    """Below the bound nothing is merged; only vertices of no triangle are left out."""
    place, triangles = sheet(10)
    place = np.concatenate([place, [[9, 9, 9]]]).astype(np.float32)
    mesh = decimate_mesh(place[None], triangles, most=1000)
    assert np.array_equal(mesh.vertices, np.arange(100))
    assert np.array_equal(mesh.triangles, triangles)


def test_a_heavy_mesh_is_drawn_with_as_many_triangles_as_allowed_and_no_more() -> None:
    """The bound holds, most of it is used, every triangle has three corners of its own, and the map is the file's."""
    place, triangles = sheet(120)
    mesh = decimate_mesh(place[None], triangles, most=5000)
    assert 2500 < len(mesh.triangles) <= 5000
    assert (np.sort(mesh.triangles, axis=1)[:, :-1] != np.sort(mesh.triangles, axis=1)[:, 1:]).all()
    assert mesh.triangles.max() == len(mesh.vertices) - 1
    assert np.abs(np.ptp(place[mesh.vertices], axis=0) - [1, 0, 1]).max() < 0.1


def test_two_sheets_that_touch_in_one_pose_are_not_sewn_together() -> None:
    """Clusters are of vertices that are close in every pose looked at."""
    lower, triangles = sheet(60)
    both = np.concatenate([triangles, triangles + len(lower)])
    touching = np.concatenate([lower, sheet(60)[0]])
    apart = np.concatenate([lower, sheet(60, height=2.0)[0]])
    mesh = decimate_mesh(np.stack([touching, apart]), both, most=2000)
    is_upper = mesh.vertices[mesh.triangles] >= len(lower)
    assert (is_upper.all(axis=1) | ~is_upper.any(axis=1)).all()
    assert is_upper.any()
    assert not is_upper.all()
