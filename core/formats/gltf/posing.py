"""Vertices of any block of frames: sample the keys, pose the nodes, morph, then skin."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from core.errors import InvalidModel
from core.formats.gltf.figure import Figure
from core.formats.gltf.kernels import morph, palette, skin, worlds
from core.formats.gltf.nodes import NodeGraph
from core.formats.gltf.sampling import Slots, Tracks

SCRATCH_BYTES = 16 * 2**20
"""Matrices and poses that one call holds at a time: however many frames are asked for, and however many nodes."""


@dataclass(frozen=True)
class Skeleton:
    """The nodes that move a figure, each after its parent (-1 at a root), and the bones hung on them."""

    parent: Int[np.ndarray, "N"]
    matrix: Float[np.ndarray, "N 12"]
    has_matrix: np.ndarray
    bone_node: Int[np.ndarray, "B"]
    bone_bind: Float[np.ndarray, "B 12"]

    def palette(self, poses: Float[np.ndarray, "block numbers"]) -> Float[np.ndarray, "block B 16"]:
        """What each bone does to a vertex bound to it: world · bind, column by column, padded to 4 x 4."""
        world = np.empty((len(poses), len(self.parent), 12))
        worlds(poses, self.parent, self.matrix, self.has_matrix, world)
        matrices = np.empty((len(poses), len(self.bone_node), 16))
        palette(world, self.bone_node, self.bone_bind, matrices)
        return matrices


def read_skeleton(graph: NodeGraph, figure: Figure) -> tuple[Skeleton, Float[np.ndarray, "numbers"], Slots]:
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


@dataclass(frozen=True)
class PosedVertices:
    """Draws frames of a glTF take; frame i is at i / `frame_rate` seconds. Safe to call from several threads.

    Matrices and sums are float64, the result float32: world = Σ weight · world[bone] · bind · position, and where
    the mesh has morph targets, its position is base + Σ weight · displacement (glTF 2.0, section 3.7).
    """

    figure: Figure
    skeleton: Skeleton
    tracks: Tracks
    weight_slots: Slots
    frame_rate: float

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        """Positions of frames [start, stop)."""
        out = np.empty((stop - start, len(self.figure.positions), 3), np.float32)
        for first in range(start, stop, self._frames_at_once):
            last = min(first + self._frames_at_once, stop)
            poses = self.tracks.poses(np.arange(first, last) / self.frame_rate)
            self._draw(first, poses, self.skeleton.palette(poses), out[first - start : last - start])
        return out

    @property
    def _frames_at_once(self) -> int:
        numbers = len(self.tracks.still) + 12 * len(self.skeleton.parent) + 16 * len(self.skeleton.bone_node)
        return max(1, SCRATCH_BYTES // (8 * numbers))

    def _draw(
        self,
        first: int,
        poses: Float[np.ndarray, "block numbers"],
        matrices: Float[np.ndarray, "block B 16"],
        out: Float[np.ndarray, "block V 3"],
    ) -> None:
        if not self.figure.morphs:
            self._skin(first, self.figure.positions, matrices, out)
            return
        positions = self.figure.positions.astype(np.float64)
        for frame in range(len(poses)):
            self._morph(poses[frame], positions)
            self._skin(first + frame, positions, matrices[frame : frame + 1], out[frame : frame + 1])

    def _morph(self, pose: Float[np.ndarray, "numbers"], positions: Float[np.ndarray, "V 3"]) -> None:
        for part in self.figure.morphs:
            weights = pose[self.weight_slots[part.node] :][: len(part.targets)]
            base = self.figure.positions[part.start : part.stop].reshape(-1)
            morph(base, part.targets, weights, positions[part.start : part.stop].reshape(-1))

    def _skin(
        self,
        first: int,
        positions: Float[np.ndarray, "V 3"],
        matrices: Float[np.ndarray, "block B 16"],
        out: Float[np.ndarray, "block V 3"],
    ) -> None:
        figure = self.figure
        good = skin(positions, figure.first, figure.bones, figure.weights, matrices, out)
        if good < len(out):
            wrong = ~np.isfinite(out[good]).all(axis=1)
            raise InvalidModel(
                "non-finite-data",
                "The pose puts a vertex where float32 cannot; look at scales and translations there.",
                frame=first + good,
                vertex=int(np.argmax(wrong)),
            )


def rest_pose(
    figure: Figure, skeleton: Skeleton, still: Float[np.ndarray, "numbers"]
) -> Float[np.ndarray, "V 3"] | None:
    """The undeformed shape: every skin as it was bound, without morph targets, in the size it has in the scene.

    A skin's bind pose is in a frame of its own. All its bones carry it to the scene alike where the skeleton
    stands in its bind pose; elsewhere the bone of median size, |det|, does it for all, so that lengths are those of
    the scene. None where float32 cannot hold it.
    """
    matrices = skeleton.palette(still[None])
    for start, stop in figure.skins:
        linear = matrices[0, start:stop].reshape(-1, 4, 4)[:, :3, :3]
        size = np.argsort(np.abs(np.linalg.det(linear)), kind="stable")
        matrices[0, start:stop] = matrices[0, start + size[len(size) // 2]]
    out = np.empty((1, len(figure.positions), 3), np.float32)
    good = skin(figure.positions, figure.first, figure.bones, figure.weights, matrices, out)
    return out[0] if good else None
