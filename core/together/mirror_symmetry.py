"""Mirror symmetry: left and right of a body, found in its poses alone.

A performer who waves with the left hand does what another does with the right. No name says which side a vertex or a
marker is on, so the plane is looked for in which some pose of some take comes nearest to its own mirror image.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.optimize import linear_sum_assignment

NEIGHBOURS = 4
MOST_RATIO = 0.45
"""How far mirrored points may miss their counterparts, of how far these are from themselves."""
MOST_MISS = 0.02
"""The ratio times how much neighbours differ from mirrored ones; 0.003 on people, 0.04 without symmetry."""
ROUNDS = 8
DIRECTIONS = 12


@dataclass(frozen=True)
class MirrorSymmetry:
    """`normal` (3,) of the plane through the mean of the points, and the `counterpart` (points,) of each point."""

    normal: Float[np.ndarray, "3"]
    counterpart: Int[np.ndarray, "points"]
    miss: float

    def matrix(self) -> Float[np.ndarray, "D D"]:
        """What mirrors poses as rows of 3 · points coordinates: row @ matrix."""
        points = len(self.counterpart)
        reflect = np.eye(3) - 2 * np.outer(self.normal, self.normal)
        found = np.zeros((points, 3, points, 3))
        found[np.arange(points), :, self.counterpart, :] = reflect
        return found.reshape(3 * points, 3 * points)


def find_mirror_symmetry(poses: Iterable[Float[np.ndarray, "points 3"]]) -> MirrorSymmetry | None:
    """The plane in which one of the poses is most symmetric; None where none of them is."""
    best: MirrorSymmetry | None = None
    for pose in poses:
        found = _symmetry_of(pose - pose.mean(axis=0))
        if found is not None and (best is None or found.miss < best.miss):
            best = found
    return best if best is not None and best.miss <= MOST_MISS else None


def _symmetry_of(pose: Float[np.ndarray, "points 3"]) -> MirrorSymmetry | None:
    apart = np.linalg.norm(pose[:, None] - pose[None, :], axis=2)
    near = np.argsort(apart + np.diag(np.full(len(pose), np.inf)), axis=1, kind="stable")[:, :NEIGHBOURS]
    size = float(np.sqrt(np.einsum("pi,pi->", pose, pose) / len(pose)))
    if size <= 0:
        return None
    best: MirrorSymmetry | None = None
    met: list[np.ndarray] = []
    for start in _directions(pose):
        normal = _settled(pose, start)
        if any(abs(float(normal @ other)) > 0.999 for other in met):
            continue
        met.append(normal)
        found = _judged(pose, normal, apart / size, near, size)
        if found is not None and (best is None or found.miss < best.miss):
            best = found
    return best


def _directions(pose: Float[np.ndarray, "points 3"]) -> Float[np.ndarray, "directions 3"]:
    """The principal axes, and more directions evenly over half a sphere."""
    axes = np.linalg.eigh(pose.T @ pose)[1].T
    height = (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
    turn = np.pi * (1 + np.sqrt(5)) * np.arange(DIRECTIONS)
    level = np.sqrt(1 - height**2)
    return np.concatenate([axes, np.stack([level * np.cos(turn), level * np.sin(turn), height], axis=1)])


def _settled(pose: Float[np.ndarray, "points 3"], normal: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3"]:
    """The plane nearby that mirrors points best onto those that they are mirrored near to."""
    for _ in range(ROUNDS):
        nearest = _squares_to_mirrored(pose, normal).argmin(axis=1)
        product = pose.T @ pose[nearest]
        better = np.linalg.eigh(product + product.T)[1][:, 0]
        if abs(float(better @ normal)) > 1 - 1e-9:
            break
        normal = better
    return normal


def _judged(
    pose: Float[np.ndarray, "points 3"],
    normal: Float[np.ndarray, "3"],
    apart: Float[np.ndarray, "points points"],
    near: Int[np.ndarray, "points neighbours"],
    size: float,
) -> MirrorSymmetry | None:
    """How much a plane misses; None where points are mirrored onto themselves, as between front and back."""
    squares = _squares_to_mirrored(pose, normal)
    rows, other = linear_sum_assignment(squares)
    missed = float(np.sqrt(squares[rows, other].mean())) / size
    moved = float(np.sqrt(((pose - pose[other]) ** 2).sum(axis=1).mean())) / size
    if missed > MOST_RATIO * moved or moved == 0:
        return None
    mine = np.take_along_axis(apart, near, axis=1)
    theirs = apart[other[:, None], other[near]]
    bones = float(np.sqrt(((mine - theirs) ** 2).mean()))
    return MirrorSymmetry(normal, np.asarray(other, np.int64), bones * missed / moved)


def _squares_to_mirrored(
    pose: Float[np.ndarray, "points 3"], normal: Float[np.ndarray, "3"]
) -> Float[np.ndarray, "points points"]:
    """[i, j]: the squared distance of point i, mirrored, and point j."""
    mirrored = pose - 2 * np.outer(pose @ normal, normal)
    squares = (mirrored**2).sum(axis=1)[:, None] + (pose**2).sum(axis=1)[None, :] - 2 * mirrored @ pose.T
    return np.asarray(np.maximum(squares, 0.0))
