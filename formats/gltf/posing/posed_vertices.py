"""Vertices of any block of frames: sample the keys, pose the nodes, morph, then skin."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from caesura.core.errors import InvalidModel
from caesura.formats.gltf.animation.sampling import KeyTracks, PoseSlots
from caesura.formats.gltf.posing.skeleton import Skeleton
from caesura.formats.gltf.scene_mesh import SceneMesh
from caesura.formats.kernels.posing import skin_morphed_vertices, skin_vertices

MOST_FRAMES = 32
"""Frames that are drawn at a time: enough for vector instructions, few enough that all matrices stay near."""

SCRATCH_BYTES = 16 * 2**20
"""Matrices and poses that one call holds at a time: however many frames are asked for, and however many nodes."""


@dataclass(frozen=True)
class PosedVertices:
    """Draws frames of a glTF take; frame i is at `start_seconds` + i / `frame_rate`. Safe to call from several threads.

    Matrices and sums are float64, the result float32: world = Σ weight · world[bone] · bind · position, and where
    the mesh has morph targets, its position is base + Σ weight · displacement (glTF 2.0, section 3.7).
    """

    figure: SceneMesh
    skeleton: Skeleton
    tracks: KeyTracks
    weight_slots: PoseSlots
    frame_rate: float
    start_seconds: float = 0.0

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        """Positions of frames [start, stop); raises `non-finite-data` naming frame and vertex."""
        out = np.empty((stop - start, len(self.figure.positions), 3), np.float32)
        for first in range(start, stop, self._frames_at_once):
            last = min(first + self._frames_at_once, stop)
            poses = self.tracks.poses(self.start_seconds + np.arange(first, last) / self.frame_rate)
            block = out[first - start : last - start]
            if not self._draw(poses, self.skeleton.palette(poses), block):
                frame, vertex = np.argwhere(~np.isfinite(block).all(axis=2))[0].tolist()
                raise InvalidModel(
                    "non-finite-data",
                    "The pose puts a vertex where float32 cannot; look at scales and translations there.",
                    frame=first + frame,
                    vertex=vertex,
                )
        return out

    @property
    def _frames_at_once(self) -> int:
        numbers = len(self.tracks.rest_pose) + 12 * len(self.skeleton.parent) + 12 * len(self.skeleton.bone_node)
        return min(max(SCRATCH_BYTES // (8 * numbers), 1), MOST_FRAMES)

    def _draw(
        self,
        poses: Float[np.ndarray, "block numbers"],
        matrices: Float[np.ndarray, "B 12 block"],
        out: Float[np.ndarray, "block V 3"],
    ) -> bool:
        finite = True
        for part in self.figure.parts:
            positions, first = self.figure.positions[part.start : part.stop], self.figure.first[part.start :]
            rest = (first, self.figure.bones, self.figure.weights, matrices, part.start, out)
            if part.targets is None:
                finite &= skin_vertices(positions, *rest)
            else:
                slot = self.weight_slots[part.node]
                shares = poses[:, slot : slot + len(part.targets)].T
                used = shares.any(axis=1)
                targets = part.targets if used.all() else part.targets[used]
                finite &= skin_morphed_vertices(positions, targets, np.ascontiguousarray(shares[used]), *rest)
        return finite


def sample_rest_pose(
    figure: SceneMesh, skeleton: Skeleton, still: Float[np.ndarray, "numbers"]
) -> Float[np.ndarray, "V 3"] | None:
    """The undeformed shape: every skin as it was bound, without morph targets, in the size it has in the scene.

    A skin's bind pose is in a frame of its own. All its bones carry it to the scene alike where the skeleton
    stands in its bind pose; elsewhere the bone of median size, |det|, does it for all, so that lengths are those of
    the scene. None where float32 cannot hold it.
    """
    matrices = skeleton.palette(still[None])
    for start, stop in figure.skins:
        linear = matrices[start:stop, :, 0].reshape(-1, 3, 4)[:, :, :3]
        size = np.argsort(np.abs(np.linalg.det(linear)), kind="stable")
        matrices[start:stop] = matrices[start + size[len(size) // 2]]
    out = np.empty((1, len(figure.positions), 3), np.float32)
    finite = skin_vertices(figure.positions, figure.first, figure.bones, figure.weights, matrices, 0, out)
    return out[0] if finite else None
