"""A glTF as the page plays it: decoded geometry, the take alone, and nothing else.

Three.js skins it on the GPU, so a long take stays as small as its keys. Images, other takes, names and most
extensions are left out, and materials are plain: their images come in a file of their own; sparse, quantized, strip
and fan geometry is plain triangles of floats. Every vertex carries `_PATCH`, the patch of the surface whose strain
colours it. Only the four strongest joints of a vertex are kept, as many as three.js knows. Joints of a skeleton
without a mesh are marked `joint` in their extras.
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from jaxtyping import Float, Int, Shaped, UInt16

from caesura.core.errors import InputError
from caesura.core.limits import Limits
from caesura.formats.gltf.animation.channels import WIDTHS, Channel, morph_targets
from caesura.formats.gltf.animation.take_choice import choose_animation
from caesura.formats.gltf.geometry.accessors import Accessors
from caesura.formats.gltf.geometry.primitives import PrimitiveHeader, read_primitive, read_primitive_headers
from caesura.formats.gltf.geometry.skin_weights import SkinWeights
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.posing.node_graph import read_nodes, scene_nodes
from caesura.formats.gltf.posing.skins import read_skin
from caesura.formats.gltf.scene_mesh import default_morph_weights
from caesura.formats.gltf.skeleton_joints import find_moving_joints
from caesura.formats.playback.glb_stream import GlbStream
from caesura.formats.playback.materials import EXTENSIONS, MOST_TEXTURE_COORDINATES, Materials
from caesura.formats.read import find_main_part

JOINTS_KEPT = 4  # of a vertex; three.js reads JOINTS_0 alone
PLACEMENT = ("translation", "rotation", "scale", "matrix")


def write_playable_gltf(
    parts: Mapping[str, memoryview], take: int, patch_of_vertex: Int[np.ndarray, "V"]
) -> tuple[Iterator[bytes], Iterator[bytes] | None]:
    """The GLB, and its materials with their images or None where there are none, each piece by piece.

    The file has been read before, so its limits are not asked again.

    `patch_of_vertex` is in the order in which the reader takes vertices: nodes depth first, then primitives.
    """
    beside = dict(parts)
    document = GltfDocument(beside.pop("" if "" in parts else find_main_part(parts)), beside, Limits.none())
    made = _PlayableGltf(document, take, patch_of_vertex)
    return made.pieces(), made.materials.textured()


class _PlayableGltf:
    """The parts of one file, being copied."""

    def __init__(self, document: GltfDocument, take: int, patch_of_vertex: Int[np.ndarray, "V"]) -> None:
        self._document = document
        self._accessors = Accessors(document)
        self._patches = patch_of_vertex
        self._out = GlbStream()
        self.materials = Materials(document)
        self._skins: dict[int, int] = {}
        graph = read_nodes(document)
        scene = scene_nodes(document, graph)
        self._roots = [node for node in scene if graph.parent[node] < 0]
        for entry in document.nodes:
            placed = {name: entry.value[name] for name in PLACEMENT if name in entry.value}
            children = entry.values("children")
            self._out.add("nodes", placed | ({"children": list(children)} if children else {}))
        _, _, channels = choose_animation(document, self._accessors, take)
        with_mesh = [node for node in scene if "mesh" in document.nodes[node]]
        for node in with_mesh:
            self._mesh(node)
        if not with_mesh:
            for node in find_moving_joints(document, scene, graph.parent.tolist(), channels):
                self._out.parts["nodes"][node]["extras"] = {"joint": True}
        self._animation(channels)
        for material in self.materials.plain():
            self._out.add("materials", material)
        self._out.extensions |= EXTENSIONS

    def pieces(self) -> Iterator[bytes]:
        """The file."""
        return self._out.pieces(self._roots)

    def _mesh(self, node: int) -> None:
        """The mesh of a node, as its own: the same mesh elsewhere is strained otherwise."""
        entry = self._document.nodes[node]
        mesh = self._document.meshes[entry.index("mesh", len(self._document.meshes), "meshes")]
        skinned: list[dict[str, Any]] = []
        rigid: list[dict[str, Any]] = []
        for outline in read_primitive_headers(self._document, self._accessors, mesh):
            primitive, bends = self._primitive(outline, entry)
            (skinned if bends and "skin" in entry else rigid).append(primitive)
        place = self._out.parts["nodes"][node]
        if rigid and skinned:  # what has no joints moves with its node, beside what has
            below = self._out.add("nodes", self._add_mesh_node(rigid, entry))
            place["children"] = [*place.get("children", []), below]
        elif rigid:
            place |= self._add_mesh_node(rigid, entry)
        if skinned:
            place |= self._add_mesh_node(skinned, entry) | {"skin": self._skin(entry)}

    def _add_mesh_node(self, primitives: list[dict[str, Any]], entry: JsonObject) -> dict[str, Any]:
        weights = default_morph_weights(self._document, entry)
        mesh = {"primitives": primitives} | ({"weights": list(weights)} if weights else {})
        return {"mesh": self._out.add("meshes", mesh)}

    def _primitive(self, outline: PrimitiveHeader, entry: JsonObject) -> tuple[dict[str, Any], bool]:
        """One primitive, and whether it has joints."""
        decoded = read_primitive(self._document, self._accessors, outline)
        count = len(decoded.positions)
        patch, self._patches = self._patches[:count], self._patches[count:]
        attributes = {
            "POSITION": self._out.array(decoded.positions, bounds=True),
            "_PATCH": self._out.array(patch.astype(np.float32)),
        }
        normals = self._values_of_vertices(outline, "NORMAL", ("VEC3",))  # without them the page draws facets
        if normals is not None:
            attributes["NORMAL"] = self._out.array(normals)
        if decoded.influences is not None and "skin" in entry:
            joints, weights = _strongest_influences(decoded.influences)
            attributes["JOINTS_0"] = self._out.array(joints)
            attributes["WEIGHTS_0"] = self._out.array(weights)
        primitive = {
            "attributes": attributes,
            "indices": self._out.array(decoded.triangles.reshape(-1).astype(np.uint32)),
        }
        material = self.materials.number(outline.entry)
        if material is not None:
            primitive["material"] = material
            attributes |= self._appearance(outline)
        missing = np.zeros_like(decoded.positions)
        targets = [*decoded.targets, *[missing] * (morph_targets(self._document, entry) - len(decoded.targets))]
        if targets:
            primitive["targets"] = [{"POSITION": self._out.array(target, bounds=True)} for target in targets]
        return primitive, decoded.influences is not None

    def _appearance(self, outline: PrimitiveHeader) -> dict[str, int]:
        """Where images lie on the surface, and the colours of its vertices."""
        wanted = {f"TEXCOORD_{n}": ("VEC2",) for n in range(MOST_TEXTURE_COORDINATES)} | {"COLOR_0": ("VEC3", "VEC4")}
        found = {name: self._values_of_vertices(outline, name, types) for name, types in wanted.items()}
        return {name: self._out.array(values) for name, values in found.items() if values is not None}

    def _values_of_vertices(
        self, outline: PrimitiveHeader, name: str, types: tuple[str, ...]
    ) -> Float[np.ndarray, "V components"] | None:
        """They only serve the look: faulty ones are left out."""
        layout = outline.attributes.get(name)
        if layout is None or layout.type not in types:
            return None
        try:
            return self._accessors.floats(layout, vertex_data=True)
        except InputError:
            return None

    def _skin(self, entry: JsonObject) -> int:
        number = entry.index("skin", len(self._document.skins), "skins")
        if number not in self._skins:
            skin = read_skin(self._document, self._accessors, number)
            bind = np.tile(np.eye(4, dtype=np.float32), (len(skin.joints), 1, 1))
            bind[:, :3] = skin.bind.reshape(-1, 3, 4)
            columns = np.ascontiguousarray(bind.transpose(0, 2, 1))  # matrices are stored by columns
            joints = {"joints": skin.joints.tolist(), "inverseBindMatrices": self._out.array(columns)}
            self._skins[number] = self._out.add("skins", joints)
        return self._skins[number]

    def _animation(self, channels: list[Channel]) -> None:
        """The take. Key times that many channels share are written once; values are read when they are written."""
        inputs: dict[int, int] = {}
        samplers: list[dict[str, Any]] = []
        targets: list[dict[str, Any]] = []
        for channel in channels:
            if channel.input.index not in inputs:
                times = self._accessors.floats(channel.input).reshape(-1)
                inputs[channel.input.index] = self._out.array(times, bounds=True)
            samplers.append(
                {
                    "input": inputs[channel.input.index],
                    "output": self._values(channel),
                    "interpolation": channel.interpolation,
                }
            )
            targets.append({"sampler": len(targets), "target": {"node": channel.node, "path": channel.path}})
        self._out.add("animations", {"channels": targets, "samplers": samplers})

    def _values(self, channel: Channel) -> int:
        layout = channel.output
        shape = (layout.count, WIDTHS[channel.path]) if channel.path in WIDTHS else (layout.count * layout.width,)

        def draw() -> Shaped[np.ndarray, "..."]:
            return self._accessors.floats(layout).reshape(shape)

        return self._out.streamed_accessor("float32", shape, draw)


def _strongest_influences(influences: SkinWeights) -> tuple[UInt16[np.ndarray, "V 4"], Float[np.ndarray, "V 4"]]:
    """The four strongest joints of each vertex, uint16, and their weights, float32, of sum 1."""
    order = np.argsort(-influences.weights, axis=1, kind="stable")[:, :JOINTS_KEPT]
    weights = np.take_along_axis(influences.weights, order, 1)
    joints = np.where(weights > 0, np.take_along_axis(influences.joints, order, 1), 0)
    return joints.astype(np.uint16), (weights / weights.sum(axis=1, keepdims=True)).astype(np.float32)
