"""Skin weights that melt into one another: heat diffused over the surface from the bones."""

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csc_matrix, diags
from scipy.sparse.linalg import splu

from caesura.samples.surface import Limb, Surface

INFLUENCES = 4  # what every engine supports


def heat_weights(surface: Surface, limbs: list[Limb], bones: int, sharpness: float) -> Float[np.ndarray, "V bones"]:
    """Weights in [0, 1] summing to 1 (Baran and Popović 2007): (-Δ + H) w = H p.

    `p` is 1 for the bone whose limb a vertex lies on, and H = `sharpness` / (distance to its axis)², so that
    joints blend over about the thickness of the limb; larger is sharper.
    """
    owner, axis_distance = _owners(surface, limbs)
    heat = diags(sharpness / axis_distance**2)
    system = (_laplacian(surface) + heat).tocsc()
    held = heat @ np.eye(bones)[owner]
    weights: Float[np.ndarray, "V bones"] = np.clip(splu(system).solve(held), 0.0, None)
    weights /= weights.sum(axis=1, keepdims=True)
    return weights


def strongest(
    weights: Float[np.ndarray, "V bones"],
) -> tuple[Int[np.ndarray, "V 4"], Float[np.ndarray, "V 4"]]:
    """The four strongest bones of each vertex and their weights, which sum to 1; unused places hold bone 0.

    What the fifth bone has is taken from all four, so that a bone fades out before it is left out: without that
    the surface tears where neighbours keep different bones.
    """
    order = np.argsort(-weights, axis=1, kind="stable")[:, : INFLUENCES + 1]
    kept = np.take_along_axis(weights, order, axis=1)
    kept = np.clip(kept[:, :-1] - kept[:, -1:], 0.0, None)
    kept[kept < 1e-3] = 0.0
    kept /= kept.sum(axis=1, keepdims=True)
    return np.where(kept > 0, order[:, :-1], 0), kept


def _owners(surface: Surface, limbs: list[Limb]) -> tuple[Int[np.ndarray, "V"], Float[np.ndarray, "V"]]:
    distances = np.stack([limb.distance(surface.vertices) for limb in limbs])
    nearest = distances.argmin(axis=0)
    radius = np.array([min(limb.start_radius, limb.end_radius) for limb in limbs])[nearest]
    owners = np.array([limb.owner for limb in limbs])[nearest]
    return owners, radius + np.maximum(distances.min(axis=0), 0.0)


def _laplacian(surface: Surface) -> csc_matrix:
    """-Δ for triangles of nearly equal size: Σ (f_i - f_j) · 2 / (3 h²), exact on a lattice of equilateral ones."""
    t = surface.triangles
    i, j = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]).T
    squared = ((surface.vertices[i] - surface.vertices[j]) ** 2).sum(axis=1).mean()
    count = len(surface.vertices)
    edges = csc_matrix((np.full(len(i), 2 / (3 * squared)), (i, j)), shape=(count, count))
    return (diags(np.asarray(edges.sum(axis=1)).ravel()) - edges).tocsc()
