"""Patches: the surface in a few hundred coherent pieces of about equal area.

A descriptor per triangle is as long as the mesh is fine; its area-weighted mean on each patch has a fixed length,
whatever the mesh, and is what streams into the projection.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from caesura.core.mesh.farthest_points import sample_farthest_points


def assign_patches(
    rest: Float[np.ndarray, "V 3"], triangles: Int[np.ndarray, "T 3"], count: int = 256
) -> Int[np.ndarray, "T"]:
    """The patch, 0 … patches−1 with patches ≤ `count`, of every triangle: that of the nearest seed.

    Seeds are spread over the centroids of the triangles that have area, so that every patch has some; triangles
    without area join the patch they lie in. Same patches for the same mesh, whatever the machine's threads.
    No triangles, no patches; a mesh without any area is one patch.
    """
    if len(triangles) == 0:
        return np.zeros(0, np.int64)
    corners = rest[triangles]
    edges = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    has_area = np.any(edges != 0, axis=1)
    if not has_area.any():
        return np.zeros(len(triangles), np.int64)
    patch = sample_farthest_points(corners.mean(axis=1), count, has_area).nearest
    return _make_contiguous(patch, has_area)


def _make_contiguous(patch: Int[np.ndarray, "T"], has_area: Bool[np.ndarray, "T"]) -> Int[np.ndarray, "T"]:
    """A seed may lose its own triangle to none but itself, so every patch is met; renumbering guards the promise."""
    met = np.unique(patch[has_area])
    return np.searchsorted(met, patch).clip(max=len(met) - 1)
