"""The figures' skeleton: joints, how they bend, and where they are for given angles."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.spatial.transform import Rotation

# Joint, parent, place when standing straight with hanging arms: metres, y up, facing +z, the left side at +x.
TRUNK = (
    ("hips", None, (0.0, 0.95, 0.0)),
    ("spine", "hips", (0.0, 1.06, -0.005)),
    ("chest", "spine", (0.0, 1.24, -0.01)),
    ("neck", "chest", (0.0, 1.47, -0.015)),
    ("head", "neck", (0.0, 1.57, 0.005)),
)
LIMBS = (
    ("clavicle", "chest", (0.03, 1.415, 0.0)),
    ("upper_arm", "clavicle", (0.185, 1.405, -0.015)),
    ("forearm", "upper_arm", (0.185, 1.12, -0.02)),
    ("hand", "forearm", (0.185, 0.87, -0.01)),
    ("thigh", "hips", (0.092, 0.91, 0.0)),
    ("shin", "thigh", (0.092, 0.495, 0.005)),
    ("foot", "shin", (0.092, 0.085, -0.02)),
    ("toes", "foot", (0.092, 0.03, 0.11)),
)
# Rotations about x, z, y for one degree of flexion (forward, or the way the joint bends), of sideways movement
# (to the left, or outward) and of twist (to the left, or outward). Right limbs mirror the last two.
TRUNK_SIGNS = (1.0, -1.0, 1.0)
LIMB_SIGNS = {"shin": (1.0, 1.0, 1.0), "toes": (-1.0, 1.0, 1.0)}
OTHER_LIMB_SIGNS = (-1.0, 1.0, 1.0)
AXES = ("flex", "side", "twist")


@dataclass(frozen=True)
class Skeleton:
    """Joints in an order where parents come first. `places` are those of the straight stance."""

    names: tuple[str, ...]
    parents: tuple[int, ...]  # -1 for the root
    places: Float[np.ndarray, "J 3"]
    signs: Float[np.ndarray, "J 3"]

    @property
    def offsets(self) -> Float[np.ndarray, "J 3"]:
        """Each joint's place in its parent."""
        parents = np.array(self.parents)
        return self.places - np.where(parents[:, None] < 0, 0.0, self.places[parents])

    def index(self, name: str) -> int:
        """The number of a joint."""
        return self.names.index(name)

    def rotations(self, angles: Float[np.ndarray, "*n J 3"]) -> Float[np.ndarray, "*n J 3 3"]:
        """Local rotations Rx Rz Ry of angles (flexion, sideways, twist) in degrees: the twist comes first."""
        x, z, y = np.moveaxis(np.radians(angles * self.signs), -1, 0)
        cx, cy, cz, sx, sy, sz = np.cos(x), np.cos(y), np.cos(z), np.sin(x), np.sin(y), np.sin(z)
        rows = (
            (cz * cy, -sz, cz * sy),
            (cx * sz * cy + sx * sy, cx * cz, cx * sz * sy - sx * cy),
            (sx * sz * cy - cx * sy, sx * cz, sx * sz * sy + cx * cy),
        )
        return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    def pose(
        self, angles: Float[np.ndarray, "*n J 3"]
    ) -> tuple[Float[np.ndarray, "*n J 3 3"], Float[np.ndarray, "*n J 3"]]:
        """Rotations and places of all joints in the world, the root standing at its own place."""
        local, offsets = self.rotations(angles), self.offsets
        world = np.empty_like(local)
        places = np.empty(local.shape[:-1])
        for joint, parent in enumerate(self.parents):
            if parent < 0:
                world[..., joint, :, :], places[..., joint, :] = local[..., joint, :, :], offsets[joint]
            else:
                world[..., joint, :, :] = world[..., parent, :, :] @ local[..., joint, :, :]
                places[..., joint, :] = places[..., parent, :] + world[..., parent, :, :] @ offsets[joint]
        return world, places


def quaternions(rotations: Float[np.ndarray, "frames 3 3"]) -> Float[np.ndarray, "frames 4"]:
    """Unit quaternions (x, y, z, w) of a course of rotations, with signs that never jump between frames."""
    q: Float[np.ndarray, "frames 4"] = Rotation.from_matrix(rotations).as_quat()
    flips = np.where((q[1:] * q[:-1]).sum(axis=1) < 0, -1.0, 1.0)
    q *= np.concatenate([[1.0], np.cumprod(flips)])[:, None]
    return q


def _human() -> Skeleton:
    rows = [(name, parent, place, TRUNK_SIGNS) for name, parent, place in TRUNK]
    for side, mirror in ((".L", 1.0), (".R", -1.0)):
        for name, parent, (x, y, z) in LIMBS:
            up = parent if parent in {row[0] for row in TRUNK} else parent + side
            flex, out, twist = LIMB_SIGNS.get(name, OTHER_LIMB_SIGNS)
            rows.append((name + side, up, (mirror * x, y, z), (flex, mirror * out, mirror * twist)))
    names = tuple(row[0] for row in rows)
    parents = tuple(-1 if parent is None else names.index(parent) for _, parent, _, _ in rows)
    return Skeleton(names, parents, np.array([row[2] for row in rows]), np.array([row[3] for row in rows]))


HUMAN = _human()
JOINTS = len(HUMAN.names)


def straight() -> Float[np.ndarray, "J 3"]:
    """Angles of the straight stance with hanging arms: zeros, to be filled."""
    return np.zeros((JOINTS, 3))


def arms_out(degrees: float) -> Float[np.ndarray, "J 3"]:
    """Angles of standing with the arms so far from the body: 90 is the T-pose, 40 the A-pose figures are bound in."""
    angles = straight()
    for side in (".L", ".R"):
        angles[HUMAN.index("upper_arm" + side), 1] = degrees
        angles[HUMAN.index("thigh" + side), 1] = 5.0
        angles[HUMAN.index("foot" + side), 1] = -5.0
    return angles


BIND = arms_out(40.0)
