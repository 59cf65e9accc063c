"""The graph of nodes: a forest, or the file is refused."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import InvalidModel
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.gltf.json_object import JsonObject

T, R, S = slice(0, 3), slice(3, 7), slice(7, 10)
"""Where translation, rotation (x, y, z, w) and scale lie in the ten numbers of a node's pose."""

STILL: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0)


OFF_UNIT = 0.02
"""Squared length that a rotation may miss 1 by and still be used as it is."""


@dataclass(frozen=True)
class NodeGraph:
    """All nodes of the file.

    `parent` is -1 at a root. `order` lists every node after its parent. `pose` is each node's own translation,
    rotation and scale; where `has_matrix`, `matrix` (row by row, 3 x 4) stands instead.
    """

    entries: list[JsonObject]
    parent: Int[np.ndarray, "N"]
    order: Int[np.ndarray, "N"]
    children: list[list[int]]
    pose: Float[np.ndarray, "N 10"]
    matrix: Float[np.ndarray, "N 12"]
    has_matrix: np.ndarray

    def with_ancestors(self, nodes: Int[np.ndarray, "some"]) -> Int[np.ndarray, "more"]:
        """The nodes and all that is above them, every node after its parent."""
        kept = np.zeros(len(self.parent), bool)
        for node in nodes.tolist():
            above = node
            while above >= 0 and not kept[above]:
                kept[above] = True
                above = int(self.parent[above])
        found: Int[np.ndarray, "more"] = self.order[kept[self.order]]
        return found


def read_nodes(document: GltfDocument) -> NodeGraph:
    """The nodes of the file; raises `invalid-node-graph` where they are no forest."""
    entries = document.nodes
    children = [_children(entry, len(entries)) for entry in entries]
    parent = np.full(len(entries), -1)
    for node, below in enumerate(children):
        for child in below:
            if parent[child] >= 0 or child == node:
                raise entries[child].refusal("The node has two parents, or is its own.", "invalid-node-graph")
            parent[child] = node
    order = _parents_first(parent, children)
    if len(order) < len(entries):
        lost = next(iter(set(range(len(entries))) - set(order)))
        raise entries[lost].refusal("The node is below itself.", "invalid-node-graph")
    pose, matrix = np.tile(STILL, (len(entries), 1)), np.zeros((len(entries), 12))
    has_matrix = np.array(["matrix" in entry for entry in entries], bool)
    for node, entry in enumerate(entries):
        if has_matrix[node]:
            matrix[node] = np.reshape(entry.numbers("matrix", 16, ()), (4, 4)).T[:3].reshape(-1)
        else:
            _read_pose(entry, pose[node])
    pose[:, R] = unit_rotations(pose[:, R])
    return NodeGraph(entries, parent, np.array(order, np.int64), children, pose, matrix, has_matrix)


def scene_nodes(document: GltfDocument, graph: NodeGraph) -> list[int]:
    """The nodes of the default scene, depth first, children in their order."""
    stack = _scene_roots(document, graph)[::-1]
    found = []
    while stack:
        node = stack.pop()
        found.append(node)
        stack.extend(graph.children[node][::-1])
    return found


def _scene_roots(document: GltfDocument, graph: NodeGraph) -> list[int]:
    scenes = document.root.entries("scenes")
    if not scenes:
        document.notices.add("no-scene", "The file has no scene; all its nodes were taken.")
        return [node for node in graph.order.tolist() if graph.parent[node] < 0]
    if "scene" not in document.root:
        if len(scenes) > 1:
            document.notices.add(
                "no-default-scene", f"The file names none of its {len(scenes)} scenes; the first was taken."
            )
        chosen = 0
    else:
        chosen = document.root.index("scene", len(scenes), "scenes", "invalid-node-graph")
    roots: list[int] = []
    for place, node in enumerate(scenes[chosen].values("nodes")):
        if type(node) is not int or not 0 <= node < len(graph.parent) or graph.parent[node] >= 0 or node in roots[-1:]:
            raise InvalidModel(
                "invalid-node-graph", "A scene must list root nodes.", pointer=f"{scenes[chosen].pointer}/nodes/{place}"
            )
        roots.append(node)
    if any(a == b for a, b in pairwise(sorted(roots))):
        raise scenes[chosen].refusal("The scene lists a node twice.", "invalid-node-graph", "nodes")
    return roots


def _children(entry: JsonObject, count: int) -> list[int]:
    children: list[int] = entry.values("children")
    for place, child in enumerate(children):
        if type(child) is not int or not 0 <= child < count:
            raise entry.refusal(f"There is no such node among {count}.", "invalid-node-graph", f"children/{place}")
    return children


def _parents_first(parent: Int[np.ndarray, "N"], children: list[list[int]]) -> list[int]:
    """Every node that can be reached, after its parent; without recursion, for chains may be long."""
    order = np.flatnonzero(parent < 0).tolist()
    for node in order:
        order.extend(children[node])  # the list grows while it is walked: breadth first
    return order


def _read_pose(entry: JsonObject, pose: Float[np.ndarray, "10"]) -> None:
    if not entry.value.keys() & {"translation", "rotation", "scale"}:
        return
    pose[T] = entry.numbers("translation", 3, STILL[T])
    pose[R] = entry.numbers("rotation", 4, STILL[R])
    pose[S] = entry.numbers("scale", 3, STILL[S])
    if not pose[R] @ pose[R] > 0:  # or so small that it has no direction
        raise entry.refusal("The rotation is zero, which is no rotation.", name="rotation")


def unit_rotations(
    rotations: Float[np.ndarray, "rotations 4"], *, rounded: bool = False
) -> Float[np.ndarray, "rotations 4"]:
    """Quaternions of unit length. Those off by rounding to a few digits stay what the file says, as in three.js.

    `rounded` ones, from integers, are all normalised: their rounding is the format's and not the file's.
    """
    square = np.einsum("rq,rq->r", rotations, rotations, dtype=np.float64)[:, None]
    kept = (np.abs(square - 1) <= OFF_UNIT) & (not rounded)
    return np.where(kept, rotations, rotations / np.sqrt(square)).astype(rotations.dtype)
