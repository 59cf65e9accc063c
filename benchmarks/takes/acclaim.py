"""Reads motion capture in Acclaim form: a skeleton (.asf) and its motion (.amc), and places the bones.

Every bone has an axis, a rotation C from the world at rest to the frame in which its angles are told. Its rotation
in its parent is L = C M C⁻¹ with M made of the angles, in the order in which they are listed; so the bone's own
rotation is that of its parent times L, and it leads from its parent's end along its direction at rest.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

METRES = 0.0254  # an inch: Acclaim lengths, divided by the file's own unit, are inches
AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True)
class Bone:
    """A bone at rest, in metres and world directions. `freedoms` are as listed: rx, ry, rz, also tx … for the root."""

    name: str
    parent: int  # -1 for the root
    vector: Float[np.ndarray, "3"]
    axis: Float[np.ndarray, "3 3"]
    freedoms: tuple[str, ...]


@dataclass(frozen=True)
class Acclaim:
    """A skeleton; parents come first, and bone 0 is the root, a point. `unit` turns its lengths into metres."""

    bones: tuple[Bone, ...]
    unit: float

    def index(self, name: str) -> int:
        """The number of a bone."""
        return [bone.name for bone in self.bones].index(name)

    def pose(
        self, motion: Mapping[str, Float[np.ndarray, "frames freedoms"]], frames: int
    ) -> tuple[Float[np.ndarray, "frames bones 3 3"], Float[np.ndarray, "frames bones 3"]]:
        """Rotations of all bones from rest, and the places of their starts, in the world, in metres.

        A bone that the motion does not mention rests in its parent.
        """
        rotations = np.empty((frames, len(self.bones), 3, 3))
        starts = np.zeros((frames, len(self.bones), 3))
        for number, bone in enumerate(self.bones):
            values = motion.get(bone.name, np.zeros((frames, len(bone.freedoms))))
            turn = np.broadcast_to(np.eye(3), (frames, 3, 3))
            for freedom, course in zip(bone.freedoms, values.T, strict=True):
                if freedom.startswith("r"):
                    turn = rotation(freedom[1], course) @ turn
                elif freedom.startswith("t"):
                    starts[:, number, AXES[freedom[1]]] += course * self.unit
            local = bone.axis @ turn @ bone.axis.T
            if bone.parent < 0:
                rotations[:, number] = local
                continue
            above = rotations[:, bone.parent]
            rotations[:, number] = above @ local
            starts[:, number] = starts[:, bone.parent] + above @ self.bones[bone.parent].vector
        return rotations, starts


def rotation(axis: str, degrees: Float[np.ndarray, "*n"]) -> Float[np.ndarray, "*n 3 3"]:
    """Rotations about one of the coordinate axes."""
    angle = np.radians(degrees)
    u, v = (AXES[axis] + 1) % 3, (AXES[axis] + 2) % 3
    matrix = np.zeros((*angle.shape, 3, 3))
    matrix[..., AXES[axis], AXES[axis]] = 1.0
    matrix[..., u, u] = matrix[..., v, v] = np.cos(angle)
    matrix[..., v, u] = np.sin(angle)
    matrix[..., u, v] = -np.sin(angle)
    return matrix


def read_skeleton(text: str) -> Acclaim:
    """The skeleton of an .asf file with angles in degrees."""
    sections = _sections(text)
    words = [line.split() for line in sections["units"]]
    unit = METRES / next(float(word[1]) for word in words if word[0] == "length")
    if ["angle", "deg"] not in words:
        raise ValueError("this skeleton does not tell its angles in degrees")
    root = dict(line.split(maxsplit=1) for line in sections["root"])
    order = tuple(root["order"].lower().split())
    bones = {"root": Bone("root", -1, np.zeros(3), _axis(root["orientation"].split(), root["axis"]), order)}
    described = {b["name"][0]: b for b in _bones(sections["bonedata"])}
    for parent, *children in (line.split() for line in sections["hierarchy"] if line not in {"begin", "end"}):
        for name in children:
            bones[name] = _bone(described[name], list(bones).index(parent), unit)
    return Acclaim(tuple(bones.values()), unit)


def read_motion(text: str) -> dict[str, Float[np.ndarray, "frames freedoms"]]:
    """The angles (and the root's places) of every bone over time, from an .amc file."""
    rows: dict[str, list[list[str]]] = {}
    for line in text.splitlines():
        name, *values = line.split() or [""]
        if values and name[0] not in "#:":
            rows.setdefault(name, []).append(values)
    return {name: np.array(values, dtype=np.float64) for name, values in rows.items()}


def _sections(text: str) -> dict[str, list[str]]:
    sections: dict[str, list[str]] = {}
    current: list[str] = []
    for line in map(str.strip, text.splitlines()):
        if line.startswith(":"):
            current = sections.setdefault(line[1:].split()[0], [])
        elif line and not line.startswith("#"):
            current.append(line)
    return sections


def _bones(lines: list[str]) -> Iterator[dict[str, list[str]]]:
    bone: dict[str, list[str]] = {}
    for key, *values in map(str.split, lines):
        if key == "begin":
            bone = {}
        elif key == "end":
            yield bone
        else:
            bone[key] = values


def _bone(described: Mapping[str, list[str]], parent: int, unit: float) -> Bone:
    vector = np.array(described["direction"], dtype=np.float64) * float(described["length"][0]) * unit
    *angles, order = described["axis"]
    return Bone(described["name"][0], parent, vector, _axis(angles, order), tuple(described.get("dof", ())))


def _axis(angles: list[str], order: str) -> Float[np.ndarray, "3 3"]:
    matrix = np.eye(3)
    for axis, degrees in zip(order.lower(), angles, strict=True):
        matrix = rotation(axis, np.array(float(degrees))) @ matrix
    return matrix
