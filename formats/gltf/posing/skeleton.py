"""The nodes that move a mesh, and the transform of each bone."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.formats.gltf.animation.sampling import PoseSlots
from caesura.formats.gltf.posing.node_graph import NodeGraph
from caesura.formats.gltf.scene_mesh import SceneMesh
from caesura.formats.kernels.posing import compute_bone_matrices, compute_world_matrices


@dataclass(frozen=True)
class Skeleton:
    """The nodes that move a figure, each after its parent (-1 at a root), and the bones hung on them."""

    parent: Int[np.ndarray, "N"]
    matrix: Float[np.ndarray, "N 12"]
    has_matrix: np.ndarray
    bone_node: Int[np.ndarray, "B"]
    bone_bind: Float[np.ndarray, "B 12"]

    def palette(self, poses: Float[np.ndarray, "block numbers"]) -> Float[np.ndarray, "B 12 block"]:
        """What each bone does to a vertex bound to it: world · bind, row by row 3 x 4, the frames innermost."""
        world = np.empty((len(poses), len(self.parent), 12))
        compute_world_matrices(poses, self.parent, self.matrix, self.has_matrix, world)
        matrices = np.empty((len(self.bone_node), 12, len(poses)))
        compute_bone_matrices(world, self.bone_node, self.bone_bind, matrices)
        return matrices


def read_skeleton(graph: NodeGraph, figure: SceneMesh) -> tuple[Skeleton, Float[np.ndarray, "numbers"], PoseSlots]:
    """The nodes that move `figure`, their own poses in one row, and where each node's ten numbers begin."""
    nodes = graph.with_ancestors(figure.bone_node)
    place = np.full(len(graph.parent) + 1, -1)  # the last stands for the parent of a root, -1
    place[nodes] = np.arange(len(nodes))
    skeleton = Skeleton(
        parent=place[graph.parent[nodes]],
        matrix=graph.matrix[nodes],
        has_matrix=graph.has_matrix[nodes],
        bone_node=place[figure.bone_node],
        bone_bind=figure.bone_bind,
    )
    return skeleton, graph.pose[nodes].reshape(-1), {node: 10 * number for number, node in enumerate(nodes.tolist())}
