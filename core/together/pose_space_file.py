"""A pose space as plain arrays, and back: the members of an NPZ, beside which others may lie."""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from caesura.core.together.compared_body import ComparedBody
from caesura.core.together.pose_space import PoseSpace


def space_to_arrays(space: PoseSpace) -> dict[str, Any]:
    """Its members by name; `space` is JSON: the body, and whether it has a left and a right."""
    body = space.body
    described = {"kind": body.kind, "names": body.names, "topology": body.topology, "mirrors": space.mirrors}
    return {
        "space": np.frombuffer(json.dumps(described).encode(), np.uint8),
        "reference": space.reference,
        "directions": space.directions,
        "signs": space.signs,
    }


def space_from_arrays(stored: Mapping[str, np.ndarray]) -> PoseSpace:
    """The space that `space_to_arrays` described."""
    described = json.loads(stored["space"].tobytes())
    body = ComparedBody(described["kind"], tuple(described["names"]), described["topology"])
    return PoseSpace(body, stored["reference"], stored["directions"], stored["signs"], bool(described["mirrors"]))
