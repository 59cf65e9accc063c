"""Body poses: where the same points of a body are in every frame, without its place, heading and size.

The points are the joints of the skeleton by name, or, where there is none, vertices by number. Every pose is turned
and moved onto the take's own median pose (Kabsch, 1976), so that where a performer stands and looks does not count.
"""

import hashlib
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float, Float32, Int

from caesura.core.animation import Animation, Vertices
from caesura.core.errors import InvalidModel
from caesura.core.frames.blocks import frames_per_block, split_into_blocks

STEPS_PER_SECOND = 15.0
"""So many poses of a second are compared: twice the quickest swing of a limb."""
MOST_POINTS = 96
"""Vertices that are measured, and joints that are compared."""
MOST_JOINTS = 256
"""That are measured; of more, evenly by name."""
MOST_STEPS = 40_000
"""Of a take, which is three quarters of an hour; a longer one is looked at less often."""
LEAST_POINTS = 3
TURNS = 3
"""Rounds of turning every pose onto the median pose, and taking the median again."""
BLOCK_STEPS = 4096


@dataclass(frozen=True)
class BodyPoses:
    """The poses of one take.

    `places` (steps, points, 3), float32, in sizes of the body (the root mean square distance of its points from their
    mean), about their mean in every step. Step i is frame i · `stride` of the `frames` of the take, at `frame_rate`
    frames a second. `names` are those of the joints, or numbers of vertices of the `topology`, which is empty for
    joints.
    """

    kind: Literal["joints", "vertices"]
    names: tuple[str, ...]
    topology: str
    places: Float32[np.ndarray, "steps points 3"]
    frames: int
    frame_rate: float
    stride: int

    @property
    def rate(self) -> float:
        """Steps a second."""
        return self.frame_rate / self.stride

    @property
    def steps(self) -> int:
        """How many poses there are."""
        return len(self.places)

    def to_bytes(self) -> bytes:
        """As an NPZ of plain arrays; places are rounded to half precision, a thousandth of the body."""
        out = io.BytesIO()
        np.savez_compressed(
            out,
            kind=np.array(self.kind),
            names=np.array(self.names),
            topology=np.array(self.topology),
            places=self.places.astype(np.float16),
            timing=np.array([self.frames, self.frame_rate, self.stride], np.float64),
        )
        return out.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> "BodyPoses":
        """The poses that `to_bytes` wrote, to half precision."""
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            frames, frame_rate, stride = stored["timing"].tolist()
            kind: Literal["joints", "vertices"] = "joints" if str(stored["kind"]) == "joints" else "vertices"
            return cls(
                kind=kind,
                names=tuple(stored["names"].tolist()),
                topology=str(stored["topology"]),
                places=stored["places"].astype(np.float32),
                frames=int(frames),
                frame_rate=float(frame_rate),
                stride=int(stride),
            )


def measure_poses(animation: Animation) -> BodyPoses:
    """The poses of a take; vertices are drawn once, and held only as the few points that are compared.

    Raises `InvalidModel`: `not-comparable` for a body of fewer than three points, `non-finite-data` naming the frame.
    """
    joints = animation.joints
    if joints is not None and len(joints.names) >= LEAST_POINTS:
        plain, topology, source = plain_names(joints.names), "", joints.positions
        chosen = choose_joints(plain)
        names = tuple(plain[i] for i in chosen.tolist())
    else:
        chosen = choose_vertices(animation)
        names, topology, source = tuple(map(str, chosen.tolist())), describe_topology(animation), animation.vertices
    if len(names) < LEAST_POINTS:
        detail = f"The body has {len(names)} points; takes are compared by the places of at least {LEAST_POINTS}."
        raise InvalidModel("not-comparable", detail)
    stride = max(round(animation.frame_rate / STEPS_PER_SECOND), -(-animation.frames // MOST_STEPS), 1)
    places = np.concatenate(list(_read_places(animation, source, chosen, stride)))
    return BodyPoses(
        kind="vertices" if topology else "joints",
        names=names,
        topology=topology,
        places=align_poses(places),
        frames=animation.frames,
        frame_rate=animation.frame_rate,
        stride=stride,
    )


def plain_names(names: tuple[str, ...]) -> tuple[str, ...]:
    """Names of joints without the name space that a program put before them, in small letters, each of its own."""
    met: dict[str, int] = {}
    plain = []
    for name in names:
        short = re.split(r"[:|]", name)[-1].strip().lower()
        met[short] = met.get(short, 0) + 1
        plain.append(short if met[short] == 1 else f"{short} {met[short]}")
    return tuple(plain)


def choose_joints(names: tuple[str, ...]) -> Int[np.ndarray, "joints"]:
    """At most `MOST_JOINTS`, evenly by name: the same of every take with the same joints, whatever their order."""
    if len(names) <= MOST_JOINTS:
        return np.arange(len(names))
    order = np.argsort(np.array(names), kind="stable")
    return np.sort(order[np.linspace(0, len(names) - 1, MOST_JOINTS).round().astype(np.int64)])


def choose_vertices(animation: Animation) -> Int[np.ndarray, "points"]:
    """At most `MOST_POINTS` vertices, evenly by number: the same of every take of a topology, whatever its shape."""
    used = np.unique(animation.triangles) if len(animation.triangles) else np.arange(animation.vertex_count)
    if 4 * len(used) < animation.vertex_count:  # a few triangles between markers: all of them move
        used = np.arange(animation.vertex_count)
    if len(used) <= MOST_POINTS:
        return np.asarray(used, np.int64)
    return np.asarray(used[np.linspace(0, len(used) - 1, MOST_POINTS).round().astype(np.int64)], np.int64)


def describe_topology(animation: Animation) -> str:
    """The numbers of vertices and triangles, and a digest of who is joined to whom."""
    corners = np.ascontiguousarray(animation.triangles, np.int64)
    digest = hashlib.sha256(corners.tobytes()).hexdigest()[:16]
    return f"{animation.vertex_count} vertices in {len(corners)} triangles, {digest}"


def align_poses(places: Float32[np.ndarray, "steps points 3"]) -> Float32[np.ndarray, "steps points 3"]:
    """Every pose about its mean, turned onto the median pose, in sizes of that."""
    centred = places - places.mean(axis=1, keepdims=True)
    median = centred[len(centred) // 2].astype(np.float64)
    for _ in range(TURNS):
        for start in range(0, len(centred), BLOCK_STEPS):
            block = centred[start : start + BLOCK_STEPS]
            block[...] = turn_onto(block, median)
        median = np.median(centred, axis=0).astype(np.float64)
    size = float(np.sqrt(np.einsum("pi,pi->", median, median) / len(median)))
    return np.asarray(centred / np.float32(size or 1.0), np.float32)


def turn_onto(
    poses: Float[np.ndarray, "steps points 3"], target: Float[np.ndarray, "points 3"]
) -> Float[np.ndarray, "steps points 3"]:
    """Each pose turned, never mirrored, so that its points are as near to those of the target as can be."""
    left, _, right = np.linalg.svd(np.einsum("spi,pj->sij", poses, target))
    flipped = np.linalg.det(left @ right) < 0
    left[flipped, :, -1] *= -1
    return np.asarray(poses @ (left @ right), np.float32)


def _read_places(
    animation: Animation, source: Vertices, chosen: Int[np.ndarray, "points"], stride: int
) -> Iterator[Float32[np.ndarray, "steps points 3"]]:
    """The chosen points of every `stride`-th frame, block by block."""
    size = max(frames_per_block(max(animation.vertex_count, 1)) // stride, 1) * stride
    for start, stop in split_into_blocks(animation.frames, size):
        places = np.asarray(source(start, stop)[::stride][:, chosen], np.float32)
        finite = np.isfinite(places).all(axis=(1, 2))
        if not finite.all():
            frame = start + int(np.argmin(finite)) * stride
            raise InvalidModel("non-finite-data", "A point of the body is at no place in space.", frame=frame)
        yield places
