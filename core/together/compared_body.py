"""The compared body: the points that several takes have in common, or what differs."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float32

from caesura.core.errors import InvalidModel
from caesura.core.together.body_poses import LEAST_POINTS, MOST_POINTS, BodyPoses

COMMON_SHARE = 0.75
"""Of the joints of the take with the most: fewer in common are another skeleton."""
SHOWN = 5


@dataclass(frozen=True)
class ComparedBody:
    """Points by name, in a fixed order: joints of a skeleton, or vertices of a topology."""

    kind: Literal["joints", "vertices"]
    names: tuple[str, ...]
    topology: str

    @classmethod
    def of(cls, takes: Sequence[tuple[str, BodyPoses]]) -> "ComparedBody":
        """What the takes, each with its name, have in common: the same topology, or most joints of one skeleton.

        Raises `InvalidModel` (`not-comparable`) saying which two takes differ, and in what.
        """
        name, first = takes[0]
        common = set(first.names).intersection(*(other.names for _, other in takes))
        names = [joint for joint in first.names if joint in common]
        most_name, most = max(takes, key=lambda take: len(take[1].names))
        for other_name, other in takes:
            if (other.kind, other.topology) != (first.kind, first.topology):
                raise _other_body(name, first, other_name, other)
        if len(names) < max(COMMON_SHARE * len(most.names), LEAST_POINTS):
            fewest_name, fewest = min(takes, key=lambda take: len(set(take[1].names) & set(most.names)))
            raise _other_body(most_name, most, fewest_name, fewest)
        if len(names) > MOST_POINTS:
            names = [names[i] for i in np.linspace(0, len(names) - 1, MOST_POINTS).round().astype(np.int64).tolist()]
        return cls(first.kind, tuple(names), first.topology)

    def check(self, name: str, poses: BodyPoses) -> None:
        """Raise `InvalidModel` (`not-comparable`) where the take has not all of these points."""
        missing = set(self.names) - set(poses.names)
        if (poses.kind, poses.topology) != (self.kind, self.topology) or missing:
            mine = BodyPoses(
                self.kind, self.names, self.topology, np.zeros((1, len(self.names), 3), np.float32), 1, 1, 1
            )
            raise _other_body("the collection", mine, name, poses)

    def places(self, poses: BodyPoses) -> Float32[np.ndarray, "steps points 3"]:
        """The places of these points, in this order, about their mean."""
        order = {name: i for i, name in enumerate(poses.names)}
        chosen = poses.places[:, [order[name] for name in self.names]]
        return np.asarray(chosen - chosen.mean(axis=1, keepdims=True))


def _other_body(name: str, one: BodyPoses, other_name: str, other: BodyPoses) -> InvalidModel:
    """What differs between two takes that cannot be compared."""
    if one.kind != other.kind:
        differs = f"{name} has {_describe(one)}, {other_name} {_describe(other)}"
    elif one.kind == "vertices":
        differs = f"{name} has {one.topology}; {other_name} has {other.topology}"
    else:
        missing, more = sorted(set(one.names) - set(other.names)), sorted(set(other.names) - set(one.names))
        parts = [f"{other_name} lacks {_listed(missing)} of {name}"] * bool(missing)
        parts += [f"{name} lacks {_listed(more)} of {other_name}"] * bool(more)
        differs = "; ".join(parts)
    detail = f"These takes are of different bodies: {differs}. Takes of one topology or one skeleton are compared."
    return InvalidModel("not-comparable", detail, take=other_name)


def _describe(poses: BodyPoses) -> str:
    return f"a skeleton of {len(poses.names)} joints" if poses.kind == "joints" else poses.topology


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(repr(name[:40]) for name in names[:SHOWN]) + more
