"""Posed joints: the skeleton that moves a mesh, as points with names."""

from dataclasses import replace

import numpy as np
from jaxtyping import Int

from caesura.core.animation import Joints, Vertices
from caesura.formats.gltf.posing.node_graph import NodeGraph
from caesura.formats.gltf.posing.posed_vertices import PosedVertices
from caesura.formats.gltf.posing.skins import IDENTITY
from caesura.formats.gltf.scene_mesh import SceneMesh, joints_as_scene_mesh
from caesura.formats.takes.joined_takes import JoinedTakes


def find_joints(figure: SceneMesh, graph: NodeGraph, vertices: Vertices) -> Joints | None:
    """The joints of all skins, or where there is none the nodes that carry the meshes; None where a name is missing.

    `vertices` draw the figure, and the joints are drawn as they are: at the same frames.
    """
    of_skins = [np.arange(start, stop) for start, stop in figure.skins]
    bones = np.concatenate(of_skins) if of_skins else np.arange(len(figure.bone_node))
    nodes, first = np.unique(figure.bone_node[bones], return_index=True)
    names = [graph.entries[node].value.get("name") for node in nodes.tolist()]
    if not all(isinstance(name, str) and name for name in names):
        return None
    return Joints(tuple(map(str, names)), _draw_joints(vertices, nodes, bones[first]))


def _draw_joints(vertices: Vertices, nodes: Int[np.ndarray, "joints"], bones: Int[np.ndarray, "joints"]) -> Vertices:
    """The same take or takes, with the joints in the place of the mesh."""
    if isinstance(vertices, JoinedTakes):
        return replace(vertices, takes=tuple(_draw_joints(take, nodes, bones) for take in vertices.takes))
    if not isinstance(vertices, PosedVertices):
        return vertices
    skeleton = replace(
        vertices.skeleton,
        bone_node=vertices.skeleton.bone_node[bones],
        bone_bind=np.tile(IDENTITY, (len(bones), 1)),
    )
    return replace(vertices, figure=joints_as_scene_mesh(nodes), skeleton=skeleton, weight_slots={})
