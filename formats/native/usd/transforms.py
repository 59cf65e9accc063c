"""Matrices as translation, rotation and scale. USD has matrices for rows: a point stands before its matrix."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float
from scipy.spatial.transform import Rotation

SHEAR = 1e-5
"""Cosine of the angle between two axes, beyond which they are not orthogonal."""
FLAT = 1e-9
"""Volume of three axes of length 1, below which they turn nothing."""


@dataclass(frozen=True)
class Places:
    """Translations, rotations (x, y, z, w) and scales; `sheared` says that they do not hold the matrices."""

    translation: Float[np.ndarray, "n 3"]
    rotation: Float[np.ndarray, "n 4"]
    scale: Float[np.ndarray, "n 3"]
    sheared: bool


def matrices(values: Any) -> Float[np.ndarray, "n 4 4"]:
    """Matrices of the library."""
    return np.array([np.array(value) for value in values], np.float64).reshape(-1, 4, 4)


def decompose(found: Float[np.ndarray, "n 4 4"]) -> Places:
    """Each matrix as scale, then rotation, then translation; a mirrored one has its x scaled by less than 0."""
    linear = found[:, :3, :3]
    scale = np.linalg.norm(linear, axis=2)
    mirrored = np.linalg.det(linear) < 0
    scale[:, 0] *= np.where(mirrored, -1.0, 1.0)
    axes = np.divide(linear, scale[:, :, None], out=np.zeros_like(linear), where=np.abs(scale[:, :, None]) > 1e-12)
    flat = (np.abs(scale) <= 1e-12).any(axis=1) | ~np.isfinite(axes).all(axis=(1, 2))
    axes[flat] = np.eye(3)
    angles = np.abs(axes @ axes.transpose(0, 2, 1) - np.eye(3)).max(initial=0.0)
    axes[~(np.linalg.det(axes) > FLAT)] = np.eye(3)  # axes in a plane, or too long for their length to be a number
    rotation = Rotation.from_matrix(axes.transpose(0, 2, 1)).as_quat() if len(found) else np.zeros((0, 4))
    return Places(found[:, 3, :3], rotation, scale, bool(angles > SHEAR))


def on_one_side(rotations: Float[np.ndarray, "frames 4"]) -> Float[np.ndarray, "frames 4"]:
    """The same rotations, of which none is the negative of how the one before it would be written."""
    turned = np.einsum("fi,fi->f", rotations[1:], rotations[:-1]) < 0
    signs = np.where(np.concatenate([[0], np.cumsum(turned)]) % 2, -1.0, 1.0)
    return np.asarray(rotations * signs[:, None])
