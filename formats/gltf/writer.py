"""Writes GLB 2.0: arrays and names in, the bytes of one file out."""

import json
import struct
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import blake2b
from typing import Any, Literal, SupportsFloat

import numpy as np
from jaxtyping import Float, Int, Shaped

COMPONENTS = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "uint32": 5125, "float32": 5126}
SHAPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}
VERTEX_DATA, TRIANGLE_DATA = 34962, 34963  # bufferView.target of glTF, section 5.11

Triple = Iterable[SupportsFloat]
Quadruple = Iterable[SupportsFloat]  # a rotation as x, y, z, w, or a colour as red, green, blue, alpha
Path = Literal["translation", "rotation", "scale", "weights"]
Interpolation = Literal["LINEAR", "STEP", "CUBICSPLINE"]


@dataclass(frozen=True)
class Primitive:
    """Triangles of one material. `targets` are morph targets: displacements of the positions."""

    positions: Float[np.ndarray, "V 3"]
    triangles: Int[np.ndarray, "T 3"]
    normals: Float[np.ndarray, "V 3"] | None = None
    colours: Float[np.ndarray, "V 3"] | None = None  # linear red, green, blue in [0, 1]
    joints: Int[np.ndarray, "V influences"] | None = None  # in fours
    weights: Float[np.ndarray, "V influences"] | None = None
    targets: Sequence[Float[np.ndarray, "V 3"]] = ()
    material: int | None = None


@dataclass(frozen=True)
class Channel:
    """The course of one property of one node: `values` (keys, …) at `times` (keys,), in seconds, increasing."""

    node: int
    path: Path
    times: Float[np.ndarray, "keys"]
    values: Shaped[np.ndarray, "..."]
    interpolation: Interpolation = "LINEAR"


@dataclass
class GlbWriter:
    """Collects the parts of a scene; every method answers the index that later parts refer to.

    Parents come before children: `node(parent=…)`. Nodes without a parent are the roots of the one scene.
    Arrays that occur twice, such as the key times of many channels, are stored once. The same calls give the
    same bytes.
    """

    generator: str = "Caesura"
    _parts: dict[str, list[dict[str, Any]]] = field(default_factory=dict)
    _blob: bytearray = field(default_factory=bytearray)
    _stored: dict[tuple[Any, ...], int] = field(default_factory=dict)

    def accessor(self, values: Shaped[np.ndarray, "..."], *, target: int | None = None, bounds: bool = False) -> int:
        """Stores `values` (n, …) of a component type that glTF has; `bounds` adds min and max."""
        shape, dtype = values.shape[1:], values.dtype.name
        if dtype not in COMPONENTS or shape not in SHAPES or len(values) == 0:
            raise ValueError(f"glTF has no accessor for {dtype} {values.shape}")
        rows = values.transpose(0, 2, 1) if shape == (4, 4) else values  # matrices are stored by columns
        data = np.ascontiguousarray(rows).tobytes()
        key = (dtype, values.shape, target, bounds, blake2b(data).digest())
        if key not in self._stored:
            accessor = {
                "bufferView": self._view(data, target),
                "componentType": COMPONENTS[dtype],
                "count": len(values),
                "type": SHAPES[shape],
            }
            if bounds:
                flat = values.reshape(len(values), -1)
                accessor |= {"min": flat.min(axis=0).tolist(), "max": flat.max(axis=0).tolist()}
            self._stored[key] = self._add("accessors", accessor)
        return self._stored[key]

    def material(self, name: str, color: Quadruple, *, metallic: float = 0.0, roughness: float = 0.8) -> int:
        """A plain surface; `color` is linear red, green, blue, alpha in [0, 1]."""
        surface = {
            "baseColorFactor": [float(x) for x in color],
            "metallicFactor": metallic,
            "roughnessFactor": roughness,
        }
        return self._add("materials", {"name": name, "pbrMetallicRoughness": surface})

    def mesh(self, name: str, primitives: Sequence[Primitive], *, weights: Sequence[float] = ()) -> int:
        """A mesh; `weights` are those of its morph targets at rest."""
        mesh: dict[str, Any] = {"name": name, "primitives": [self._primitive(p) for p in primitives]}
        return self._add("meshes", mesh | ({"weights": list(weights)} if weights else {}))

    def node(
        self,
        name: str,
        *,
        parent: int | None = None,
        translation: Triple | None = None,
        rotation: Quadruple | None = None,
        scale: Triple | None = None,
        mesh: int | None = None,
        skin: int | None = None,
    ) -> int:
        """A node of the scene, placed in its parent."""
        places = {"translation": translation, "rotation": rotation, "scale": scale}
        node: dict[str, Any] = {"name": name} | {k: [float(x) for x in v] for k, v in places.items() if v is not None}
        node |= {k: v for k, v in {"mesh": mesh, "skin": skin}.items() if v is not None}
        index = self._add("nodes", node)
        if parent is not None:
            self._parts["nodes"][parent].setdefault("children", []).append(index)
        return index

    def attach_mesh(self, node: int, mesh: int, skin: int | None = None) -> None:
        """Give a node its mesh, and the skin that moves it, where these are made after it."""
        self._parts["nodes"][node] |= {"mesh": mesh} | ({} if skin is None else {"skin": skin})

    def skin(self, joints: Sequence[int], inverse_bind: Float[np.ndarray, "J 4 4"], *, name: str = "skin") -> int:
        """A skin: its joint nodes, and for each the matrix from the mesh at rest into the joint's own space."""
        matrices = self.accessor(inverse_bind.astype(np.float32))
        return self._add("skins", {"name": name, "joints": list(joints), "inverseBindMatrices": matrices})

    def animation(self, name: str, channels: Sequence[Channel]) -> int:
        """One animation of the file: a take, or a clip of it."""
        samplers = [
            {
                "input": self.accessor(c.times.astype(np.float32), bounds=True),
                "interpolation": c.interpolation,
                "output": self.accessor(np.asarray(c.values, dtype=np.float32)),
            }
            for c in channels
        ]
        targets = [{"sampler": i, "target": {"node": c.node, "path": c.path}} for i, c in enumerate(channels)]
        return self._add("animations", {"name": name, "channels": targets, "samplers": samplers})

    def to_bytes(self, extras: Mapping[str, Any] | None = None) -> bytes:
        """The file. `extras` are free words about it, kept under `asset`."""
        nodes = self._parts.get("nodes", [])
        children = {child for node in nodes for child in node.get("children", [])}
        document: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": self.generator} | ({"extras": dict(extras)} if extras else {}),
            "scene": 0,
            "scenes": [{"nodes": [i for i in range(len(nodes)) if i not in children]}],
            **self._parts,
        }
        if self._blob:
            document["buffers"] = [{"byteLength": len(self._blob)}]
        text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
        chunks = [_chunk(b"JSON", text, b" ")] + ([_chunk(b"BIN\0", bytes(self._blob), b"\0")] if self._blob else [])
        length = 12 + sum(map(len, chunks))
        return b"".join([struct.pack("<4sII", b"glTF", 2, length), *chunks])

    def _primitive(self, p: Primitive) -> dict[str, Any]:
        def attribute(values: Float[np.ndarray, "V 3"], *, bounds: bool = False) -> int:
            return self.accessor(values.astype(np.float32), target=VERTEX_DATA, bounds=bounds)

        attributes = {"POSITION": attribute(p.positions, bounds=True)}
        if p.normals is not None:
            attributes["NORMAL"] = attribute(p.normals)
        if p.colours is not None:
            attributes["COLOR_0"] = attribute(p.colours)
        if p.joints is not None and p.weights is not None:
            narrow = "uint8" if p.joints.max() < 256 else "uint16"
            for first in range(0, p.joints.shape[1], 4):
                joints, weights = p.joints[:, first : first + 4], p.weights[:, first : first + 4]
                attributes[f"JOINTS_{first // 4}"] = self.accessor(joints.astype(narrow), target=VERTEX_DATA)
                attributes[f"WEIGHTS_{first // 4}"] = self.accessor(weights.astype(np.float32), target=VERTEX_DATA)
        narrow = "uint16" if len(p.positions) < 65_536 else "uint32"  # index 65,535 would restart a strip
        corners = self.accessor(p.triangles.reshape(-1).astype(narrow), target=TRIANGLE_DATA)
        primitive: dict[str, Any] = {"attributes": attributes, "indices": corners, "mode": 4}
        if p.targets:
            primitive["targets"] = [{"POSITION": attribute(t, bounds=True)} for t in p.targets]
        return primitive | ({} if p.material is None else {"material": p.material})

    def _view(self, data: bytes, target: int | None) -> int:
        self._blob.extend(bytes(-len(self._blob) % 4))  # every component type divides 4
        view = {"buffer": 0, "byteOffset": len(self._blob), "byteLength": len(data)}
        self._blob.extend(data)
        return self._add("bufferViews", view | ({} if target is None else {"target": target}))

    def _add(self, kind: str, part: dict[str, Any]) -> int:
        parts = self._parts.setdefault(kind, [])
        parts.append(part)
        return len(parts) - 1


def _chunk(kind: bytes, data: bytes, padding: bytes) -> bytes:
    data += padding * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data
