"""The poses of an armature as the GLB that the service reads: a node for each bone, with a key on every frame."""

import json
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

Z_UP_TO_Y_UP = (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)
SMALLEST = 1e-12
FLOAT = 5126


class SkeletonFile:
    """A GLB in the making. Parents stand before their children; a bone's `length` ends it where nothing is below it."""

    def __init__(
        self, frames: int, names: Sequence[str], parents: Sequence[int], lengths: Sequence[float], rate: float
    ) -> None:
        self._names, self._parents, self._lengths = list(names), list(parents), list(lengths)
        self._rate = rate
        nodes = len(names) + 1  # the armature itself comes first
        self._filled = 0
        self._places = np.empty((nodes, frames, 3), "<f4")
        self._turns = np.empty((nodes, frames, 4), "<f4")
        self._sizes = np.empty((nodes, frames, 3), "<f4")

    def write(self, bones: Any, worlds: Any) -> None:
        """Add frames: bones (n, B, 4, 4) in the armature's space, and the armature in the world (n, 4, 4)."""
        local = np.empty((len(bones), len(self._names) + 1, 4, 4))
        local[:, 0] = worlds
        for bone, parent in enumerate(self._parents):
            above = _inverse(bones[:, parent]) if parent >= 0 else None
            local[:, bone + 1] = bones[:, bone] if above is None else above @ bones[:, bone]
        here = slice(self._filled, self._filled + len(bones))
        place, turn, size = decompose(local)
        for stored, found in ((self._places, place), (self._turns, turn), (self._sizes, size)):
            stored[:, here] = found.transpose(1, 0, 2)
        self._filled += len(bones)

    def save(self, path: Path) -> None:
        """Write the file."""
        for turns in self._turns:
            signs = np.where(np.cumsum(np.einsum("fi,fi->f", turns[1:], turns[:-1]) < 0) % 2, -1.0, 1.0)
            turns[1:] *= signs[:, None]
        arrays = [(np.arange(self._filled) / self._rate).astype("<f4")]
        channels: list[dict[str, Any]] = []
        samplers: list[dict[str, Any]] = []
        for node in range(len(self._places)):
            for kind, found in (
                ("translation", self._places[node]), ("rotation", self._turns[node]), ("scale", self._sizes[node]),
            ):  # fmt: skip
                if kind == "scale" and np.ptp(found, axis=0).max(initial=0) <= 1e-6:
                    continue
                channels.append({"sampler": len(samplers), "target": {"node": node + 1, "path": kind}})
                samplers.append({"input": 0, "output": len(arrays)})
                arrays.append(found)
        animations = [{"name": "take", "channels": channels, "samplers": samplers}]
        nodes = self._nodes()
        with path.open("wb") as file:
            _write_glb(file, {"scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes, "animations": animations}, arrays)

    def _nodes(self) -> list[dict[str, Any]]:
        nodes: list[dict[str, Any]] = [{"name": "scene", "rotation": Z_UP_TO_Y_UP, "children": [1]}]
        for node, name in enumerate(["armature", *self._names]):
            found = {"translation": self._places[node], "rotation": self._turns[node], "scale": self._sizes[node]}
            nodes.append({"name": name, **{kind: values[0].tolist() for kind, values in found.items()}})
        for bone, parent in enumerate(self._parents):
            nodes[parent + 2].setdefault("children", []).append(bone + 2)
        for bone, length in enumerate(self._lengths):
            if "children" not in nodes[bone + 2]:
                nodes[bone + 2]["children"] = [len(nodes)]
                nodes.append({"name": f"{self._names[bone]}_end", "translation": [0, length, 0]})
        return nodes


def decompose(matrices: Any) -> tuple[Any, Any, Any]:
    """Matrices (…, 4, 4) as translation, rotation (x, y, z, w) and scale; of a mirrored one x is negated."""
    linear = matrices[..., :3, :3]
    size = np.linalg.norm(linear, axis=-2)
    size[..., 0] *= np.where(np.linalg.det(linear) < 0, -1.0, 1.0)
    axes = linear / np.where(np.abs(size) < SMALLEST, 1.0, size)[..., None, :]
    return matrices[..., :3, 3], quaternions(axes), size


def quaternions(axes: Any) -> Any:
    """Rotations (…, 3, 3) as unit quaternions: of the four ways to write one, that which divides by the largest."""
    m = axes
    trace = m[..., 0, 0] + m[..., 1, 1] + m[..., 2, 2]
    # Row i of this symmetric matrix is 4 q_i q, in the order x, y, z, w.
    products = np.empty((*m.shape[:-2], 4, 4))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        products[..., i, i] = 1 + 2 * m[..., i, i] - trace
        products[..., i, j] = products[..., j, i] = m[..., i, j] + m[..., j, i]
        products[..., i, 3] = products[..., 3, i] = m[..., k, j] - m[..., j, k]
    products[..., 3, 3] = 1 + trace
    largest = np.argmax(np.diagonal(products, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :]
    length = np.linalg.norm(row, axis=-1, keepdims=True)
    return np.where(length < SMALLEST, (0.0, 0.0, 0.0, 1.0), row / np.maximum(length, SMALLEST))


def _inverse(matrices: Any) -> Any:
    """Of a bone that is scaled to nothing, its place alone is undone."""
    flat = np.abs(np.linalg.det(matrices[:, :3, :3])) < SMALLEST**2
    usable = matrices.copy()
    usable[flat, :3, :3] = np.eye(3)
    return np.linalg.inv(usable)


def _write_glb(file: BinaryIO, root: dict[str, Any], arrays: Sequence[Any]) -> None:
    """A GLB of `root` whose accessors are `arrays`, one view each."""
    kinds = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
    views: list[dict[str, int]] = []
    accessors: list[dict[str, Any]] = []
    offset = 0
    for array in arrays:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": array.nbytes})
        found: dict[str, Any] = {"bufferView": len(accessors), "componentType": FLOAT, "count": len(array)}
        found["type"] = kinds[1 if array.ndim == 1 else array.shape[1]]
        if not accessors:
            found |= {"min": [float(array[0])], "max": [float(array[-1])]}
        accessors.append(found)
        offset += array.nbytes
    document = {"asset": {"version": "2.0"}, **root, "accessors": accessors, "bufferViews": views}
    text = json.dumps({**document, "buffers": [{"byteLength": offset}]}).encode()
    text += b" " * (-len(text) % 4)
    file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + offset))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", offset, b"BIN\0"))
    for array in arrays:
        file.write(np.ascontiguousarray(array).data)
