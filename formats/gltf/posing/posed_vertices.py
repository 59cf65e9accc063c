"""Vertices of any block of frames: sample the keys, pose the nodes, morph, then skin."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Float32, Int

from caesura.core.errors import InvalidModel
from caesura.core.kernels.descriptors import WIDTH
from caesura.formats.gltf.animation.sampling import KeyTracks, PoseSlots
from caesura.formats.gltf.posing.skeleton import Skeleton
from caesura.formats.gltf.scene_mesh import SceneMesh
from caesura.formats.kernels.posing import centre_matrices, skin_morphed_vertices, skin_vertices, store_frames

TILE = 1024
"""Vertices that are skinned at a time where frames are wanted one after another."""

SCRATCH_BYTES = 16 * 2**20
"""Matrices and poses that one call holds at a time: however many frames are asked for, and however many nodes."""


@dataclass(frozen=True)
class PosedBones:
    """What moves the vertices in up to `WIDTH` frames, as the kernels read it (`centre_matrices`).

    `shares` are the weights of the morph targets of each part that has some.
    """

    frames: int
    matrices: Float32[np.ndarray, "B numbers"]
    origin: Float32[np.ndarray, "3 width"]
    shares: dict[int, Float32[np.ndarray, "targets width"]]


@dataclass(frozen=True)
class PosedVertices:
    """Draws frames of a glTF take; frame i is at `start_seconds` + i / `frame_rate`. Safe to call from several threads.

    world = Σ weight · world[bone] · bind · position, and where the mesh has morph targets, its position is
    base + Σ weight · displacement (glTF 2.0, section 3.7). Matrices are float64; the sums are float32, of numbers no
    larger than the body.
    """

    figure: SceneMesh
    skeleton: Skeleton
    tracks: KeyTracks
    weight_slots: PoseSlots
    frame_rate: float
    start_seconds: float = 0.0

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        """Positions of frames [start, stop); raises `non-finite-data` naming frame and vertex."""
        vertices = len(self.figure.positions)
        out = np.empty((stop - start, vertices, 3), np.float32)
        rows = np.empty((min(TILE, vertices), 3, WIDTH), np.float32)
        for at in range(start, stop, WIDTH):
            bones, finite = self._pose(np.arange(at, min(at + WIDTH, stop))), True
            block = out[at - start : at - start + bones.frames]
            for first in range(0, vertices, TILE):
                last = min(first + TILE, vertices)
                self._skin(bones, first, last, rows, 0)
                finite &= store_frames(rows, last - first, first, block)
            if not finite:
                frame = int(np.argwhere(~np.isfinite(block).all(axis=2))[0, 0])
                raise self._refusal(at + frame, block[frame])
        return out

    def rows(self, frames: Int[np.ndarray, "n"]) -> Float32[np.ndarray, "V 3 n"]:
        """Positions in some frames, in rising order, the frames innermost; what is not finite is not looked for."""
        rows = np.empty((len(self.figure.positions), 3, len(frames)), np.float32)
        for at in range(0, len(frames), WIDTH):
            bones = self._pose(frames[at : at + WIDTH])
            self._skin(bones, 0, len(rows), rows, at)
        return rows

    def _refusal(self, frame: int, drawn: Float32[np.ndarray, "V 3"]) -> InvalidModel:
        """What to say of a frame that is not finite: by float64, for one vertex too far away draws all others along."""
        figure = self.figure
        poses = self.tracks.poses(np.array([self.start_seconds + frame / self.frame_rate]))
        matrices = self.skeleton.palette(poses)[figure.bones, :, 0].reshape(-1, 3, 4)
        vertex = np.repeat(np.arange(len(drawn)), np.diff(figure.first))
        with np.errstate(all="ignore"):
            moved = np.einsum("irc,ic->ir", matrices[:, :, :3], figure.positions[vertex]) + matrices[:, :, 3]
            exact = np.add.reduceat(moved * figure.weights[:, None], figure.first[:-1], axis=0).astype(np.float32)
        bad = np.flatnonzero(~np.isfinite(exact).all(axis=1))
        bad = bad if len(bad) else np.flatnonzero(~np.isfinite(drawn).all(axis=1))
        return InvalidModel(
            "non-finite-data",
            "The pose puts a vertex where float32 cannot; look at scales and translations there.",
            frame=frame,
            vertex=int(bad[0]),
        )

    def _pose(self, frames: Int[np.ndarray, "n"]) -> PosedBones:
        """At most `WIDTH` frames, and of those only as many at a time as `SCRATCH_BYTES` holds."""
        morphed = {p.start: (p.targets, self.weight_slots[p.node]) for p in self.figure.parts if p.targets is not None}
        bones = PosedBones(
            len(frames),
            np.empty((len(self.skeleton.bone_node), 12 * WIDTH), np.float32),
            np.empty((3, WIDTH), np.float32),
            {start: np.zeros((len(targets), WIDTH), np.float32) for start, (targets, _) in morphed.items()},
        )
        at_once = self._frames_at_once
        centres, anchor = self._centres
        for at in range(0, len(frames), at_once):
            poses = self.tracks.poses(self.start_seconds + frames[at : at + at_once] / self.frame_rate)
            centre_matrices(self.skeleton.palette(poses), centres, anchor, at, bones.matrices, bones.origin)
            for start, (targets, slot) in morphed.items():
                bones.shares[start][:, at : at + len(poses)] = poses[:, slot : slot + len(targets)].T
        return bones

    @property
    def _frames_at_once(self) -> int:
        numbers = len(self.tracks.rest_pose) + 12 * len(self.skeleton.parent) + 12 * len(self.skeleton.bone_node)
        return min(max(SCRATCH_BYTES // (8 * numbers), 1), WIDTH)

    @cached_property
    def _weights(self) -> Float32[np.ndarray, "influences"]:
        return self.figure.weights.astype(np.float32)

    @cached_property
    def _centres(self) -> tuple[Float32[np.ndarray, "B 3"], int]:
        """The mean of the vertices that each bone moves, and the bone that moves most."""
        figure = self.figure
        moved = figure.positions[np.repeat(np.arange(len(figure.positions)), np.diff(figure.first))]
        count = np.bincount(figure.bones, minlength=len(figure.bone_node))
        sums = [np.bincount(figure.bones, axis, minlength=len(count)) for axis in moved.T]
        return (np.stack(sums, axis=1) / np.maximum(count, 1)[:, None]).astype(np.float32), int(count.argmax())

    def _skin(self, bones: PosedBones, first: int, last: int, rows: Float32[np.ndarray, "some 3 F"], at: int) -> None:
        """Vertices [first, last) in the frames of `bones`, from frame `at` of the rows on."""
        figure, centres = self.figure, self._centres[0]
        for part in figure.parts:
            start, stop = max(part.start, first), min(part.stop, last)
            if start >= stop:
                continue
            skin = (figure.positions, figure.first, figure.bones, self._weights, centres, bones.matrices, bones.origin)
            drawn = (start, stop, *skin, rows[start - first :], (at, at + bones.frames))
            if part.targets is None:
                skin_vertices(*drawn)
            else:
                used = bones.shares[part.start].any(axis=1)
                targets = part.targets if used.all() else part.targets[used]
                skin_morphed_vertices(*drawn, targets, bones.shares[part.start][used], part.start)


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
    whole = matrices[figure.bones[figure.first[:-1]], :, 0].reshape(-1, 3, 4)  # all bones of a vertex do the same
    placed = np.einsum("vrc,vc->vr", whole[:, :, :3], figure.positions) + whole[:, :, 3]
    with np.errstate(over="ignore"):
        rest = placed.astype(np.float32)
    return rest if np.isfinite(rest).all() else None
