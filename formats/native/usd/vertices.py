"""A stage as frames of vertices: points, blend shapes and skins as the library computes them, in the scene."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from jaxtyping import Float
from pxr import UsdGeom, UsdSkel, Vt

from caesura.core.limits import Limits
from caesura.formats.native.reader_answer import VerticesAnswer
from caesura.formats.native.usd.blend_shapes import blend_weights
from caesura.formats.native.usd.frame_times import Clock
from caesura.formats.native.usd.layer import library_errors
from caesura.formats.native.usd.meshes_and_skeletons import Bodies, Body

BLOCK_BYTES = 2**22


def write_vertices(bodies: Bodies, clock: Clock, to_metres: Float[np.ndarray, "4 4"], limits: Limits) -> VerticesAnswer:
    """All meshes as one; `to_metres` takes rows of the stage's space to metres with Y up."""
    first = np.cumsum([0, *(body.points for body in bodies.meshes)])
    parts = [body.triangles + start for body, start in zip(bodies.meshes, first[:-1], strict=True)]
    triangles = np.concatenate(parts)
    limits.check("max_triangle_frames", clock.frames * len(triangles), "Export a part of the take, or a lighter mesh")
    return VerticesAnswer(triangles, int(first[-1]), clock.frames, clock.rate, _blocks(bodies, clock, to_metres))


def _blocks(
    bodies: Bodies, clock: Clock, to_metres: Float[np.ndarray, "4 4"]
) -> Iterator[Float[np.ndarray, "block V 3"]]:
    at_once = max(BLOCK_BYTES // (12 * sum(body.points for body in bodies.meshes)), 1)
    shapes = {body.prim.GetPath(): _BlendedPoints(body) for body in bodies.meshes if body.is_blended}
    for start in range(0, clock.frames, at_once):
        rows = []
        for frame in range(start, min(start + at_once, clock.frames)):
            code = clock.code(frame)
            with library_errors():
                places = UsdGeom.XformCache(code)
                rows.append(np.concatenate([_points(body, shapes, code, places, to_metres) for body in bodies.meshes]))
        with np.errstate(over="ignore"):
            yield np.stack(rows).astype(np.float32)


def _points(
    body: Body, shapes: dict[Any, "_BlendedPoints"], code: float, places: Any, to_metres: Float[np.ndarray, "4 4"]
) -> Float[np.ndarray, "V 3"]:
    points = body.points_at(code)
    if body.is_blended:
        points = shapes[body.prim.GetPath()].at(points, code)
    owner = body.prim
    if body.is_skinned:
        skinned = Vt.Vec3fArray.FromNumpy(points.astype(np.float32))
        if body.skinning.ComputeSkinnedPoints(body.skeleton.ComputeSkinningTransforms(code), skinned, code):
            points, owner = np.array(skinned, np.float64), body.skeleton.GetPrim()
    matrix = np.array(places.GetLocalToWorldTransform(owner)) @ to_metres
    return np.asarray(points @ matrix[:3, :3] + matrix[3, :3])


class _BlendedPoints:
    """The points of a mesh with its blend shapes."""

    def __init__(self, body: Body) -> None:
        self._body = body
        self._query = UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(body.prim))
        self._indices = self._query.ComputeBlendShapePointIndices()
        self._offsets = self._query.ComputeSubShapePointOffsets()

    def at(self, points: Float[np.ndarray, "V 3"], code: float) -> Float[np.ndarray, "V 3"]:
        """`points` with what the shapes add at a time."""
        weights = blend_weights(self._body, code)
        if weights is None:
            return points
        moved = Vt.Vec3fArray.FromNumpy(points.astype(np.float32))
        self._query.ComputeDeformedPoints(
            *self._query.ComputeSubShapeWeights(weights), self._indices, self._offsets, moved
        )
        return np.array(moved, np.float64)
