"""In the reader's process: a USD as glTF or as vertices, each step of reading in order."""

from typing import Any

import numpy as np
from jaxtyping import Float
from pxr import Usd, UsdGeom

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.native.reader_answer import Answer
from caesura.formats.native.usd.frame_times import find_clock
from caesura.formats.native.usd.gltf_conversion import NotInGltf, write_gltf
from caesura.formats.native.usd.layer import describe_outside, library_errors, open_layer
from caesura.formats.native.usd.meshes_and_skeletons import Bodies, read_bodies
from caesura.formats.native.usd.vertices import write_vertices
from caesura.formats.notices import Notices

Z_UP_TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
"""For rows: what was z is y, what was y is -z."""


def read_stage(path: str, limits: Limits, notices: Notices) -> Answer:
    """The meshes and skeletons of the stage. Raises `BrokenContainer`, `InvalidModel` or `LimitExceeded`."""
    with library_errors():
        layer, outside = open_layer(path, limits, notices)
        stage = Usd.Stage.Open(layer, None)
        bodies = read_bodies(stage, limits)
        _require_bodies(bodies, outside)
        clock = find_clock(stage, list(bodies.samples()), limits, notices)
        to_metres = _conversion(stage)
        try:
            return write_gltf(bodies, clock, to_metres, limits)
        except NotInGltf:
            if bodies.skeletons:
                notices.add(
                    "read-as-vertices",
                    "The skeleton moves meshes as glTF cannot say: they were read as vertices, as clips will be.",
                )
            return write_vertices(bodies, clock, to_metres, limits)


def _require_bodies(bodies: Bodies, outside: tuple[str, ...]) -> None:
    if bodies.meshes or any(skeleton.GetAnimQuery() for skeleton in bodies.skeletons):
        return
    if outside:
        raise InvalidModel("external-resource", describe_outside(outside))
    listed = ", ".join(f"{count} {name}" for name, count in bodies.others.most_common(10)) or "nothing"
    raise InvalidModel("no-mesh", f"The USD has no mesh with polygons; it has {listed}. Export the animated surface.")


def _conversion(stage: Any) -> Float[np.ndarray, "4 4"]:
    """From the units and axes of the stage to metres and Y up."""
    metres = float(UsdGeom.GetStageMetersPerUnit(stage))
    size = metres if 0 < metres < 1e6 else 1.0
    turned = Z_UP_TO_Y_UP if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z else np.eye(4)
    return turned @ np.diag([size, size, size, 1.0])
