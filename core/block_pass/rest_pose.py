"""The rest shape: what every frame is compared with."""

from typing import Literal

import numpy as np
from jaxtyping import Float32, Float64

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.frames.sampled_frames import read_sampled_frames, read_vertices
from caesura.core.kernels.descriptors import REACH

MEAN_FRAMES = 200


def compute_rest_pose(animation: Animation, rule: Literal["bind", "mean"] | int) -> Float32[np.ndarray, "V 3"]:
    """`bind`: the shape the file names, else frame 0; a frame's number; or `mean`.

    The mean is over at most 200 evenly spaced frames, each first moved rigidly onto frame 0: the plain mean of a
    body that turns would shrink it. Raises
    `ParameterError` where there is no such frame, `InvalidModel` where the file's own rest shape is not finite.
    """
    if rule == "bind":
        return (
            read_vertices(animation, (0, 1))[0]
            if animation.rest is None
            else _require_finite(animation.rest.astype(np.float32))
        )
    if rule == "mean":
        return _mean_pose(animation)
    if not 0 <= rule < animation.frames:
        raise ParameterError(
            "no-such-frame", f"rest = {rule}: the take has frames 0 to {animation.frames - 1}.", parameter="rest"
        )
    return np.asarray(read_vertices(animation, (rule, rule + 1))[0])


def _require_finite(rest: Float32[np.ndarray, "V 3"]) -> Float32[np.ndarray, "V 3"]:
    outside = np.flatnonzero(~(np.abs(rest) <= REACH).all(axis=1))
    if len(outside):
        detail = f"Vertex {outside[0]} of the rest shape is at {rest[outside[0]].tolist()}: no place in space."
        raise InvalidModel("non-finite-data", detail, vertex=int(outside[0]))
    return rest


def _mean_pose(animation: Animation) -> Float32[np.ndarray, "V 3"]:
    first = read_vertices(animation, (0, 1))[0].astype(np.float64)
    centre = first.mean(axis=0)
    chosen = np.unique(np.linspace(0, animation.frames - 1, MEAN_FRAMES).round().astype(np.int64))
    total = np.zeros_like(first)
    for frame in chosen:
        total += _align_onto(
            read_sampled_frames(animation, chosen[chosen == frame])[0].astype(np.float64), first - centre
        )
    return np.asarray(total / len(chosen) + centre, np.float32)


def _align_onto(shape: Float64[np.ndarray, "V 3"], target: Float64[np.ndarray, "V 3"]) -> Float64[np.ndarray, "V 3"]:
    """The shape, centred and turned to lie on the centred target (Kabsch 1976)."""
    centred = shape - shape.mean(axis=0)
    u, _, vt = np.linalg.svd(np.einsum("vi,vj->ij", centred, target))
    u[:, -1] *= np.sign(np.linalg.det(u @ vt))
    return np.asarray(np.einsum("vi,ij->vj", centred, u @ vt))
