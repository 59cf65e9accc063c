"""Blend shapes of a mesh: how much of each there is, and each with its shapes in between as targets."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float
from pxr import UsdSkel, Vt

from caesura.core.limits import Limits
from caesura.formats.native.finite_numbers import finite_float32
from caesura.formats.native.usd.meshes_and_skeletons import Body


def blend_weights(body: Body, code: float) -> Any:
    """The weights of a mesh's blend shapes, in its own order; None where nothing gives them."""
    animation = body.skeleton.GetAnimQuery()
    weights = animation.ComputeBlendShapeWeights(code) if animation else None
    if not weights:
        return None
    of_name = dict(zip(animation.GetBlendShapeOrder() or [], weights, strict=False))
    return Vt.FloatArray([of_name.get(name, 0.0) for name in body.skinning.GetBlendShapeOrder() or []])


@dataclass(frozen=True)
class BlendTargets:
    """The shapes of a mesh: what the library asks for theirs, and the displacements of each."""

    body: Body
    query: Any
    offsets: list[Float[np.ndarray, "V 3"]]

    def shares(self, code: float) -> Float[np.ndarray, "targets"]:
        """How much of each target there is at a time."""
        found = np.zeros(len(self.offsets))
        weights = blend_weights(self.body, code)
        if weights is not None:
            amounts, _, shapes = self.query.ComputeSubShapeWeights(weights)
            np.add.at(found, np.array(shapes, np.int64), np.array(amounts, np.float64))
        return found


def read_targets(body: Body, limits: Limits) -> BlendTargets | None:
    """The targets of a mesh that is blended; None of any other."""
    if not body.is_blended:
        return None
    query = UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(body.prim))
    count = query.GetNumSubShapes()
    limits.check("max_targets", count)
    limits.check("max_target_vertices", count * body.points)
    indices, moved = query.ComputeBlendShapePointIndices(), query.ComputeSubShapePointOffsets()
    offsets = []
    for shape in range(count):
        dense = np.zeros((body.points, 3), np.float32)
        values = finite_float32(np.array(moved[shape]), f"A shape of {str(body.prim.GetPath())[-80:]!r}").reshape(-1, 3)
        listed = np.array(indices[query.GetBlendShapeIndex(shape)], np.int64)
        at = listed if len(listed) else np.arange(len(values))
        inside = (at[: len(values)] >= 0) & (at[: len(values)] < body.points)
        dense[at[: len(values)][inside]] = values[: len(at)][inside]
        offsets.append(dense)
    return BlendTargets(body, query, offsets)
