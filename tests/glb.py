"""Small glTF files, made part by part and in any state of disrepair: unlike a writer, nothing here is checked."""

import base64
import copy
import json
import struct
from typing import Any

import numpy as np

COMPONENTS = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "uint32": 5125, "float32": 5126}
TYPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}


class Glb:
    """The JSON of a glTF, `json`, and its binary data; both may be changed at will."""

    def __init__(self, **parts: Any) -> None:
        self.json: dict[str, Any] = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], **parts}
        self.binary = bytearray()

    def view(self, data: bytes, **more: Any) -> int:
        """A buffer view of `data`."""
        self.binary.extend(bytes(-len(self.binary) % 4))
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **more}
        self.binary.extend(data)
        return self._append("bufferViews", view)

    def accessor(self, values: Any, dtype: str = "float32", **more: Any) -> int:
        """An accessor of `values`, in a view of its own."""
        array = np.asarray(values, dtype)
        accessor = {
            "bufferView": self.view(array.astype(array.dtype.newbyteorder("<")).tobytes()),
            "componentType": COMPONENTS[dtype],
            "count": len(array),
            "type": TYPES[array.shape[1:]],
        }
        return self._append("accessors", accessor | more)

    def animate(
        self, node: int, path: str, times: Any, values: Any, interpolation: str = "LINEAR", **output: Any
    ) -> None:
        """One more channel of the first animation."""
        animation = self.json.setdefault("animations", [{"samplers": [], "channels": []}])[0]
        flat = np.ravel(values) if path == "weights" else values
        sampler = {
            "input": self.accessor(times),
            "output": self.accessor(flat, **output),
            "interpolation": interpolation,
        }
        animation["samplers"].append(sampler)
        animation["channels"].append(
            {"sampler": len(animation["samplers"]) - 1, "target": {"node": node, "path": path}}
        )

    def complete(self) -> dict[str, Any]:
        """The JSON, with its buffer."""
        return {"buffers": [{"byteLength": len(self.binary)}], **copy.deepcopy(self.json)}

    def glb(self) -> bytes:
        """As one file."""
        return chunks((b"JSON", json.dumps(self.complete()).encode()), (b"BIN\0", bytes(self.binary)))

    def gltf(self) -> bytes:
        """As JSON with its data inside."""
        data = base64.b64encode(self.binary).decode()
        complete = self.complete()
        complete["buffers"][0].setdefault("uri", f"data:application/octet-stream;base64,{data}")
        return json.dumps(complete).encode()

    def _append(self, name: str, value: dict[str, Any]) -> int:
        self.json.setdefault(name, []).append(value)
        return len(self.json[name]) - 1


def chunks(*parts: tuple[bytes, bytes], version: int = 2, length: int | None = None) -> bytes:
    """A GLB of these chunks, (type, data) each."""
    body = b"".join(
        struct.pack("<I4s", len(data) + -len(data) % 4, kind)
        + data.ljust(len(data) + -len(data) % 4, b" " if kind == b"JSON" else b"\0")
        for kind, data in parts
    )
    return struct.pack("<4sII", b"glTF", version, 12 + len(body) if length is None else length) + body


SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
SQUARE_TRIANGLES = [0, 1, 2, 0, 2, 3]


def square(**node: Any) -> Glb:
    """A unit square on node 0, not animated."""
    model = Glb(scene=0, scenes=[{"nodes": [0]}], nodes=[{"mesh": 0, **node}])
    attributes = {"POSITION": model.accessor(SQUARE)}
    primitive = {"attributes": attributes, "indices": model.accessor(SQUARE_TRIANGLES, "uint16")}
    model.json["meshes"] = [{"primitives": [primitive]}]
    return model


def moving_square() -> Glb:
    """A unit square that moves by (1, 0, 0) in a second, with a key at each of 30 frames."""
    model = square()
    times = np.arange(31) / 30
    model.animate(0, "translation", times, np.stack([times, 0 * times, 0 * times], axis=1))
    return model


def bending_strip() -> Glb:
    """Six vertices at heights 0, 1, 2; joint 1 at height 1 bends by 90° about z in a second; a morph target widens.

    Nodes: 0 the mesh, 1 the lower joint, 2 the upper one. Vertices at height 1 belong to both joints by half.
    """
    model = Glb(
        scene=0,
        scenes=[{"nodes": [0, 1]}],
        nodes=[{"mesh": 0, "skin": 0, "translation": [9, 9, 9]}, {"children": [2]}, {"translation": [0, 1, 0]}],
    )
    places = np.array([[x, y, 0] for y in (0, 1, 2) for x in (0, 1)], float)
    joints = np.tile([0, 1, 0, 0], (6, 1))
    weights = np.repeat([[1, 0, 0, 0], [0.5, 0.5, 0, 0], [0, 1, 0, 0]], 2, axis=0)
    bind = np.tile(np.eye(4), (2, 1, 1))
    bind[1, 3, 1] = -1  # column by column, as glTF stores matrices
    primitive = {
        "attributes": {
            "POSITION": model.accessor(places),
            "JOINTS_0": model.accessor(joints, "uint8"),
            "WEIGHTS_0": model.accessor(weights),
        },
        "indices": model.accessor([0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5], "uint16"),
        "targets": [{"POSITION": model.accessor(places * [1, 0, 0])}],
    }
    model.json["meshes"] = [{"primitives": [primitive]}]
    model.json["skins"] = [{"joints": [1, 2], "inverseBindMatrices": model.accessor(bind)}]
    half = np.sqrt(0.5)
    model.animate(2, "rotation", [0, 1], [[0, 0, 0, 1], [0, 0, half, half]])
    model.animate(0, "weights", [0, 1], [0, 1])
    return model


def strip_of_two_motions() -> Glb:
    """The strip, in a take of its own: it nods for four seconds, and then widens and narrows for four."""
    model = bending_strip()
    model.json["animations"] = [{"name": "take", "samplers": [], "channels": []}]
    times = np.arange(241) / 30
    nod = 0.6 * np.sin(6 * times) * (times < 4)
    model.animate(2, "rotation", times, np.stack([0 * times, 0 * times, np.sin(nod), np.cos(nod)], 1))
    model.animate(0, "weights", times, 0.5 * (1 - np.cos(7 * (times - 4))) * (times >= 4))
    return model
