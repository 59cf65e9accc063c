"""The joints of SMPL, SMPL-H and SMPL-X: a tree that is published with the models. Light: no NumPy.

Source: Loper, Mahmood, Romero, Pons-Moll and Black, *SMPL: A skinned multi-person linear model*, 2015; Romero, Tzionas
and Black, *Embodied hands*, 2017; Pavlakos and others, *Expressive body capture*, 2019. The lengths of the bones come
with the models, under a licence that lets nobody pass them on. Those here are our own: round numbers for a person of
1.7 m who stands with the arms held out, in metres, the left hand along x, y up, looking along z.
"""

from collections.abc import Iterator
from dataclasses import dataclass

Offset = tuple[float, float, float]


@dataclass(frozen=True)
class TreeJoint:
    """A joint below another, -1 for the root, `offset` away from it in the pose of zeros."""

    name: str
    parent: int
    offset: Offset


def _sides(name: str, parents: tuple[int, int], offset: Offset) -> tuple[TreeJoint, TreeJoint]:
    x, y, z = offset
    return TreeJoint(f"left_{name}", parents[0], offset), TreeJoint(f"right_{name}", parents[1], (-x, y, z))


BODY = (
    TreeJoint("pelvis", -1, (0, 0, 0)),
    *_sides("hip", (0, 0), (0.09, -0.08, 0)),
    TreeJoint("spine1", 0, (0, 0.11, 0)),
    *_sides("knee", (1, 2), (0, -0.4, 0)),
    TreeJoint("spine2", 3, (0, 0.13, 0)),
    *_sides("ankle", (4, 5), (0, -0.41, 0)),
    TreeJoint("spine3", 6, (0, 0.06, 0)),
    *_sides("foot", (7, 8), (0, -0.06, 0.13)),
    TreeJoint("neck", 9, (0, 0.21, 0)),
    *_sides("collar", (9, 9), (0.08, 0.12, 0)),
    TreeJoint("head", 12, (0, 0.09, 0.03)),
    *_sides("shoulder", (13, 14), (0.1, 0.03, 0)),
    *_sides("elbow", (16, 17), (0.27, 0, 0)),
    *_sides("wrist", (18, 19), (0.25, 0, 0)),
)
"""The joints that all models share, in their order."""

HANDS = _sides("hand", (20, 21), (0.09, 0, 0))
FACE = (TreeJoint("jaw", 15, (0, 0, 0.02)), *_sides("eye", (15, 15), (0.03, 0.06, 0.06)))
FINGERS = {
    "index": ((0.1, 0, 0.025), 0.03),
    "middle": ((0.1, 0, 0), 0.03),
    "pinky": ((0.08, 0, -0.045), 0.02),
    "ring": ((0.09, 0, -0.025), 0.03),
    "thumb": ((0.03, -0.01, 0.04), 0.03),
}
"""Where a finger begins from its wrist, and how long its bones are."""


def _fingers(first: int) -> Iterator[TreeJoint]:
    """The fingers of the left hand, then those of the right, three joints each, from joint `first` on."""
    number = first
    for side, wrist, sign in (("left", 20, 1.0), ("right", 21, -1.0)):
        for name, ((x, y, z), length) in FINGERS.items():
            for bone in range(3):
                offset = (sign * x, y, z) if bone == 0 else (sign * length, 0.0, 0.0)
                yield TreeJoint(f"{side}_{name}{bone + 1}", number - 1 if bone else wrist, offset)
                number += 1


TREES = {len(joints): joints for joints in (BODY, BODY + HANDS, (*BODY, *_fingers(22)), (*BODY, *FACE, *_fingers(25)))}
"""By the number of joints: 22 of the body alone, 24 of SMPL, 52 of SMPL-H, 55 of SMPL-X."""
