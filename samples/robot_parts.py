"""The rigid figure's parts: the plates and joints of a robot, each moved by one joint of the skeleton."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

Colour = tuple[float, float, float]
SHELL, STEEL, ACCENT, GLASS = (0.75, 0.77, 0.8), (0.12, 0.13, 0.15), (0.85, 0.3, 0.06), (0.02, 0.2, 0.28)
BEVEL = 0.2  # of the smallest half width
SIDES = 14  # of a cylinder


@dataclass(frozen=True)
class Part:
    """A closed convex mesh in the space of its joint, flat shaded: each face has its own corners."""

    name: str
    joint: str
    colour: Colour
    vertices: Float[np.ndarray, "V 3"]
    triangles: Int[np.ndarray, "T 3"]
    normals: Float[np.ndarray, "V 3"]


# Joint, kind, centre, half widths, colour. A box is bevelled; a drum is a cylinder along x, a post along y.
TRUNK = (
    ("hips", "box", (0.0, 0.0, 0.0), (0.13, 0.07, 0.085), STEEL),
    ("hips", "box", (0.0, -0.03, 0.07), (0.05, 0.05, 0.03), ACCENT),
    ("spine", "post", (0.0, 0.05, 0.0), (0.075, 0.09, 0.075), STEEL),
    ("chest", "box", (0.0, 0.08, 0.005), (0.165, 0.12, 0.105), SHELL),
    ("chest", "box", (0.0, 0.09, 0.105), (0.075, 0.055, 0.02), ACCENT),
    ("chest", "box", (0.0, 0.08, -0.125), (0.1, 0.09, 0.035), STEEL),
    ("neck", "post", (0.0, 0.045, 0.005), (0.042, 0.065, 0.042), STEEL),
    ("head", "box", (0.0, 0.1, 0.015), (0.088, 0.09, 0.095), SHELL),
    ("head", "box", (0.0, 0.11, 0.1), (0.07, 0.03, 0.02), GLASS),
    ("head", "post", (0.06, 0.22, -0.02), (0.008, 0.05, 0.008), ACCENT),
)
PAIRS = (
    ("clavicle", "box", (0.11, 0.0, 0.0), (0.06, 0.04, 0.05), STEEL),
    ("upper_arm", "drum", (0.0, 0.0, 0.0), (0.062, 0.072, 0.072), ACCENT),
    ("upper_arm", "box", (0.0, -0.14, 0.0), (0.042, 0.105, 0.045), SHELL),
    ("forearm", "drum", (0.0, 0.0, 0.0), (0.046, 0.046, 0.046), STEEL),
    ("forearm", "box", (0.0, -0.135, 0.0), (0.044, 0.1, 0.048), SHELL),
    ("hand", "box", (0.0, -0.05, 0.005), (0.026, 0.05, 0.042), STEEL),
    ("hand", "box", (-0.012, -0.13, -0.014), (0.015, 0.045, 0.014), STEEL),
    ("hand", "box", (-0.012, -0.13, 0.026), (0.015, 0.045, 0.014), STEEL),
    ("thigh", "drum", (0.0, 0.0, 0.0), (0.058, 0.07, 0.07), ACCENT),
    ("thigh", "box", (0.0, -0.21, 0.002), (0.064, 0.15, 0.068), SHELL),
    ("shin", "drum", (0.0, 0.0, 0.0), (0.056, 0.056, 0.056), STEEL),
    ("shin", "box", (0.0, -0.2, -0.008), (0.056, 0.15, 0.062), SHELL),
    ("shin", "box", (0.0, -0.16, 0.062), (0.034, 0.09, 0.015), ACCENT),
    ("foot", "drum", (0.0, 0.0, 0.0), (0.042, 0.042, 0.042), STEEL),
    ("foot", "box", (0.0, -0.052, 0.03), (0.054, 0.033, 0.098), SHELL),
    ("toes", "box", (0.0, -0.005, 0.045), (0.052, 0.025, 0.04), STEEL),
)


def build_parts() -> list[Part]:
    """The whole robot."""
    rows = [(joint, joint, kind, place, size, colour, 1.0) for joint, kind, place, size, colour in TRUNK]
    for side, mirror in ((".L", 1.0), (".R", -1.0)):
        rows += [(j, j + side, kind, place, size, colour, mirror) for j, kind, place, size, colour in PAIRS]
    made: list[Part] = []
    for _, joint, kind, (x, y, z), size, colour, mirror in rows:
        faces = _box(size) if kind == "box" else _cylinder(size, 0 if kind == "drum" else 1)
        number = sum(part.joint == joint for part in made) + 1
        made.append(_part(f"{joint} {number}", joint, colour, [face + np.array([mirror * x, y, z]) for face in faces]))
    return made


def _part(name: str, joint: str, colour: Colour, faces: Sequence[Float[np.ndarray, "n 3"]]) -> Part:
    """Convex faces, counter-clockwise from outside, as fans of triangles."""
    triangles: list[tuple[int, int, int]] = []
    normals: list[Float[np.ndarray, "n 3"]] = []
    first = 0
    for face in faces:
        normal = np.cross(face[1] - face[0], face[2] - face[0])
        normals.append(np.tile(normal / np.linalg.norm(normal), (len(face), 1)))
        triangles += [(first, first + i, first + i + 1) for i in range(1, len(face) - 1)]
        first += len(face)
    return Part(name, joint, colour, np.concatenate(faces), np.array(triangles), np.concatenate(normals))


def _box(half: Sequence[float]) -> list[Float[np.ndarray, "n 3"]]:
    """A box with bevelled edges: 6 faces, 12 edge strips and 8 corners of the same 24 points."""
    size, inset = np.array(half), BEVEL * min(half)
    signs = [np.array(s) for s in np.ndindex(2, 2, 2)]
    point = {
        (tuple(s), axis): (2 * s - 1) * (size - inset * (np.arange(3) != axis)) for s in signs for axis in range(3)
    }  # the corner `s` moved in along the two other axes: it lies on the face across `axis`
    groups = [[(tuple(s), axis) for axis in range(3)] for s in signs]
    for axis in range(3):
        for end in (0, 1):
            face = [(tuple(s), axis) for s in signs if s[axis] == end]
            groups.append(face)
        u, v = [a for a in range(3) if a != axis]
        for a, b in np.ndindex(2, 2):
            edge = [tuple(s) for s in signs if s[u] == a and s[v] == b]
            groups.append([(s, across) for s in edge for across in (u, v)])
    return [_outward(np.array([point[key] for key in group])) for group in groups]


def _cylinder(half: Sequence[float], axis: int) -> list[Float[np.ndarray, "n 3"]]:
    """A cylinder along an axis, as wide across as `half` says there."""
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    u, v = [a for a in range(3) if a != axis]
    rings = []
    for end in (-1.0, 1.0):
        ring = np.zeros((SIDES, 3))
        ring[:, axis], ring[:, u], ring[:, v] = end * half[axis], half[u] * np.cos(turn), half[v] * np.sin(turn)
        rings.append(ring)
    walls = [np.array([r[(i + d) % SIDES] for r in rings for d in (0, 1)]) for i in range(SIDES)]
    return [_outward(face) for face in (*rings, *walls)]


def _outward(face: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """The corners of a convex face of a body around the origin, in order, counter-clockwise from outside."""
    centre = face.mean(axis=0)
    normal = np.linalg.svd(face - centre)[2][2]
    normal *= np.sign(normal @ centre)
    right = face[0] - centre
    up = np.cross(normal, right)
    return face[np.argsort(np.arctan2((face - centre) @ up, (face - centre) @ right))]
