"""Which joints move a vertex, and by how much."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.json_object import JsonObject

LARGEST = 1e30
"""Weights beyond this are broken numbers, and not ones that someone forgot to normalise."""


@dataclass(frozen=True)
class SkinWeights:
    """`joints` and `weights` of every vertex, four for each set JOINTS_n, WEIGHTS_n. Weights sum to 1."""

    joints: Int[np.ndarray, "V influences"]
    weights: Float[np.ndarray, "V influences"]


def read_skin_weights(
    document: GltfDocument, accessors: Accessors, primitive: JsonObject, attributes: dict[str, AccessorLayout]
) -> SkinWeights | None:
    """The influences of a primitive, of all its sets; None where it has none."""
    sets = 0
    while f"JOINTS_{sets}" in attributes or f"WEIGHTS_{sets}" in attributes:
        sets += 1
    if sets == 0:
        return None
    pairs = [_set(accessors, primitive, attributes, number) for number in range(sets)]
    joints = np.concatenate([joints for joints, _ in pairs], axis=1)
    weights = np.concatenate([weights for _, weights in pairs], axis=1)
    return SkinWeights(joints, _normalised(document, primitive, weights))


def _set(
    accessors: Accessors, primitive: JsonObject, attributes: dict[str, AccessorLayout], number: int
) -> tuple[Int[np.ndarray, "V 4"], Float[np.ndarray, "V 4"]]:
    joints, weights = attributes.get(f"JOINTS_{number}"), attributes.get(f"WEIGHTS_{number}")
    if joints is None or weights is None:
        raise primitive.refusal(f"JOINTS_{number} and WEIGHTS_{number} must come together.", name="attributes")
    if joints.type != "VEC4" or joints.dtype.kind != "u" or weights.type != "VEC4":
        raise primitive.refusal("Joints must be VEC4 of unsigned integers, weights VEC4.", name="attributes")
    found = accessors.elements(joints, vertex_data=True).astype(np.int64)
    return found, accessors.floats(weights, vertex_data=True).astype(np.float64)


def _normalised(
    document: GltfDocument, primitive: JsonObject, weights: Float[np.ndarray, "V influences"]
) -> Float[np.ndarray, "V influences"]:
    """Weights of sum 1: negative ones count as 0, and where none is left the first joint has all."""
    if (np.abs(weights) > LARGEST).any():
        raise primitive.refusal("A skin weight is no share of anything.", "non-finite-data", "attributes")
    if (weights < 0).any():
        document.notices.add("weights-negative", f"{primitive.pointer} has negative skin weights; they count as 0.")
        weights = np.maximum(weights, 0)
    total = weights.sum(axis=1, keepdims=True)
    nothing: Bool[np.ndarray, "V"] = total[:, 0] == 0
    if nothing.any():
        document.notices.add(
            "weights-zero", f"{primitive.pointer} has vertices without skin weights; their first joint moves them."
        )
        weights = np.where(nothing[:, None] & (np.arange(weights.shape[1]) == 0), 1.0, weights)
        total = np.where(nothing[:, None], 1.0, total)
    # Eight-bit weights sum to 1 within their own rounding, which is no fault of the file.
    if (np.abs(total - 1) > 0.02).any():
        document.notices.add("weights-not-normalised", f"{primitive.pointer} has skin weights whose sum is not 1.")
    normalised: Float[np.ndarray, "V influences"] = weights / total
    return normalised
