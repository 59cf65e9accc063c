"""Everything that a scene draws, as one mesh: vertices, triangles, joints and morph targets."""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import InvalidModel
from caesura.core.kernels.descriptors import WIDTH
from caesura.formats.gltf.animation.channels import morph_targets
from caesura.formats.gltf.geometry.accessors import Accessors
from caesura.formats.gltf.geometry.gpu_instancing import MeshInstances, read_instances
from caesura.formats.gltf.geometry.primitives import Primitive, PrimitiveHeader, read_primitive, read_primitive_headers
from caesura.formats.gltf.geometry.skin_weights import SkinWeights
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.posing.node_graph import NodeGraph
from caesura.formats.gltf.posing.skins import IDENTITY, Skin, read_skin

BONE_BYTES = WIDTH * 12 * 4
"""Bytes of one bone's matrices in a block of frames: skins may share nodes, so that bones are more than nodes."""


@dataclass(frozen=True)
class ScenePart:
    """Vertices [start, stop). With `targets` (targets, 3 · vertices) they are displaced, weighted as `node` says."""

    start: int
    stop: int
    node: int = -1
    targets: Float[np.ndarray, "targets coordinates"] | None = None


@dataclass(frozen=True)
class SceneMesh:
    """One body of all primitives: in scene order, depth first, vertices as in their accessors.

    Vertex v is moved by the bones `bones[first[v]:first[v + 1]]` with `weights` of sum 1. A bone is a node and the
    matrix (3 x 4) that takes the vertex into its frame: a joint of a skin and its inverse bind matrix, or the node of
    a rigid mesh and the place of an instance. `skins` are the ranges [start, stop) of bones that are skins; `parts`
    are all vertices in order, those with morph targets apart from those without. `instanced` says that a node draws
    its mesh more than once.
    """

    positions: Float[np.ndarray, "V 3"]
    triangles: Int[np.ndarray, "T 3"]
    first: Int[np.ndarray, "V_1"]
    bones: Int[np.ndarray, "influences"]
    weights: Float[np.ndarray, "influences"]
    bone_node: Int[np.ndarray, "B"]
    bone_bind: Float[np.ndarray, "B 12"]
    skins: tuple[tuple[int, int], ...]
    parts: tuple[ScenePart, ...]
    instanced: bool = False


def read_scene_mesh(
    document: GltfDocument, accessors: Accessors, graph: NodeGraph, nodes: list[int]
) -> SceneMesh | None:
    """The body of the scene that has `nodes`, or None where they have no mesh.

    Raises `no-mesh` where they have meshes without a triangle, and whatever is wrong with them.
    """
    drawn = _drawn_primitives(document, accessors, graph, nodes)
    if not drawn:
        return None
    if not any(found and instances.count for _, _, found, instances in drawn):
        raise InvalidModel(
            "no-mesh",
            "The meshes of the file have no triangles. Export the surface, not points or lines.",
            pointer="/meshes",
        )
    body = _SceneMeshBuilder(document, accessors)
    for node, entry, found, instances in drawn:
        for place in instances.places(accessors) if found else ():
            for outline in found:
                body.add(node, entry, outline, place)
    return replace(body.figure(), instanced=any(instances.layouts for *_, instances in drawn))


def joints_as_scene_mesh(nodes: Int[np.ndarray, "V"]) -> SceneMesh:
    """A body whose vertices are the origins of `nodes`, without triangles: a skeleton."""
    count = len(nodes)
    return SceneMesh(
        positions=np.zeros((count, 3), np.float32),
        triangles=np.zeros((0, 3), np.int64),
        first=np.arange(count + 1),
        bones=np.arange(count),
        weights=np.ones(count),
        bone_node=nodes,
        bone_bind=np.tile(IDENTITY, (count, 1)),
        skins=(),
        parts=(ScenePart(0, count),),
    )


def _drawn_primitives(
    document: GltfDocument, accessors: Accessors, graph: NodeGraph, nodes: list[int]
) -> list[tuple[int, JsonObject, list[PrimitiveHeader], MeshInstances]]:
    """Every node with a mesh and its primitives, counted after instancing and before anything is decoded."""
    found: list[tuple[int, JsonObject, list[PrimitiveHeader], MeshInstances]] = []
    known: dict[int, list[PrimitiveHeader]] = {}
    primitives = vertices = triangles = moved = 0
    for node in nodes:
        entry = graph.entries[node]
        if "mesh" not in entry:
            continue
        mesh = entry.index("mesh", len(document.meshes), "meshes")
        instances = read_instances(document, accessors, entry)
        times = instances.count
        at, total = entry.pointer, primitives + times * len(document.meshes[mesh].values("primitives"))
        document.limits.check("max_primitives", total, pointer=at)
        if mesh not in known:
            known[mesh] = read_primitive_headers(document, accessors, document.meshes[mesh])
        primitives += times * len(known[mesh])
        vertices += times * sum(outline.vertices for outline in known[mesh])
        triangles += times * sum(outline.triangles for outline in known[mesh])
        moved += times * sum(outline.vertices * len(outline.targets) for outline in known[mesh])
        document.limits.check("max_vertices", vertices, pointer=at)
        document.limits.check("max_triangles", triangles, pointer=at)
        document.limits.check("max_target_vertices", moved, pointer=at)
        found.append((node, entry, known[mesh], instances))
    return found


class _SceneMeshBuilder:
    """Gathers primitives into one figure."""

    def __init__(self, document: GltfDocument, accessors: Accessors) -> None:
        self._document = document
        self._accessors = accessors
        self._decoded: dict[str, Primitive] = {}
        self._skins: dict[int, tuple[int, Skin]] = {}
        self._bones = 0
        self._bone_nodes: list[Int[np.ndarray, "_"]] = []
        self._binds: list[Float[np.ndarray, "_ 12"]] = []
        self._positions: list[Float[np.ndarray, "_ 3"]] = []
        self._triangles: list[Int[np.ndarray, "_ 3"]] = []
        self._counts: list[Int[np.ndarray, "_"]] = []
        self._joints: list[Int[np.ndarray, "_"]] = []
        self._weights: list[Float[np.ndarray, "_"]] = []
        self._parts: list[ScenePart] = []
        self._vertices = 0

    def add(self, node: int, entry: JsonObject, outline: PrimitiveHeader, instance: Float[np.ndarray, "12"]) -> None:
        """One primitive of the mesh of `node`, which `instance` takes into the node's own space."""
        place = outline.entry.pointer
        if place not in self._decoded:
            self._decoded[place] = read_primitive(self._document, self._accessors, outline)
        primitive = self._decoded[place]
        start, self._vertices = self._vertices, self._vertices + len(primitive.positions)
        self._positions.append(primitive.positions)
        self._triangles.append(primitive.triangles + start)
        self._add_part(start, node, primitive.targets)
        influences = primitive.influences
        if "skin" in entry and influences is not None:
            self._add_skinned(entry, outline.entry, influences)
        else:
            if "skin" in entry:
                self._document.notices.add("skin-unused", f"{place} has no joints; it moves with its node.")
            self._add_rigid(node, len(primitive.positions), instance)

    def figure(self) -> SceneMesh:
        """All that was added."""
        return SceneMesh(
            positions=np.concatenate(self._positions),
            triangles=np.concatenate(self._triangles),
            first=np.concatenate([[0], np.cumsum(np.concatenate(self._counts))]),
            bones=np.concatenate(self._joints),
            weights=np.concatenate(self._weights),
            bone_node=np.concatenate(self._bone_nodes),
            bone_bind=np.concatenate(self._binds),
            skins=tuple((start, start + len(skin.joints)) for start, skin in self._skins.values()),
            parts=tuple(self._parts),
        )

    def _add_part(self, start: int, node: int, targets: Float[np.ndarray, "targets V 3"]) -> None:
        if len(targets):
            self._parts.append(ScenePart(start, self._vertices, node, targets.reshape(len(targets), -1)))
        elif self._parts and self._parts[-1].targets is None:
            self._parts[-1] = ScenePart(self._parts[-1].start, self._vertices)
        else:
            self._parts.append(ScenePart(start, self._vertices))

    def _add_rigid(self, node: int, vertices: int, instance: Float[np.ndarray, "12"]) -> None:
        self._counts.append(np.ones(vertices, np.int64))
        self._joints.append(np.full(vertices, self._new_bones(np.array([node]), instance[None])))
        self._weights.append(np.ones(vertices))

    def _add_skinned(self, entry: JsonObject, place: JsonObject, influences: SkinWeights) -> None:
        number = entry.index("skin", len(self._document.skins), "skins")
        if number not in self._skins:
            skin = read_skin(self._document, self._accessors, number)
            self._skins[number] = (self._new_bones(skin.joints, skin.bind), skin)
        start, skin = self._skins[number]
        used = influences.weights != 0
        if (influences.joints[used] >= len(skin.joints)).any():
            raise place.refusal(f"A vertex names a joint beyond the {len(skin.joints)} of its skin.", "invalid-skin")
        self._counts.append(used.sum(axis=1))
        self._joints.append(influences.joints[used] + start)
        self._weights.append(influences.weights[used])

    def _new_bones(self, nodes: Int[np.ndarray, "_"], bind: Float[np.ndarray, "_ 12"]) -> int:
        self._document.budget.spend(len(nodes) * BONE_BYTES)
        start, self._bones = self._bones, self._bones + len(nodes)
        self._bone_nodes.append(nodes)
        self._binds.append(bind)
        return start


def default_morph_weights(document: GltfDocument, node: JsonObject) -> tuple[float, ...]:
    """The weights of a node's morph targets where nothing animates them: the node's, the mesh's, or 0."""
    targets = morph_targets(document, node)
    mesh = document.meshes[node.index("mesh", len(document.meshes), "meshes")]
    owner = node if "weights" in node else mesh
    weights = owner.numbers("weights", None, (0.0,) * targets)
    return (*weights[:targets], *(0.0,) * (targets - len(weights)))
