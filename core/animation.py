"""An animation as the method sees it: one triangulation, and vertices drawn by blocks of frames."""

from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Float32, Int

from caesura.core.segmentation_document import Notice

SHOWN_POSES = 6


@runtime_checkable
class Vertices(Protocol):
    """Draws frames. Safe to call from several threads at once, and the same bytes at every call."""

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        """Positions of frames [start, stop), float32, C-contiguous, finite; a fresh array or a read-only view."""


@runtime_checkable
class VerticesInRows(Protocol):
    """Vertices that can also be drawn with the frames innermost, which spares the loops over frames a turn."""

    def rows(self, frames: Int[np.ndarray, "n"]) -> Float32[np.ndarray, "V 3 n"]:
        """Positions in some frames, in rising order; they may hold what is not finite. Safe from several threads."""


@dataclass(frozen=True)
class Take:
    """One animation of the file. `index` is its place there; a vertex sequence is its own only take, index 0."""

    index: int
    name: str
    duration_seconds: float
    frames: int
    frame_rate: float


@dataclass(frozen=True)
class Joints:
    """The joints that move a body: their names, and where they are; `positions` draws them as vertices are drawn."""

    names: tuple[str, ...]
    positions: Vertices


@dataclass(frozen=True, repr=False)
class Animation:
    """A deforming mesh over time.

    `vertices(start, stop)` draws frames [start, stop) as float32 (block, V, 3); nothing holds all frames at once.
    `rest` is the undeformed shape the file itself names (bind pose, base mesh), or None where it names none
    (then the method takes frame 0). A skeleton without a mesh has `triangles` of shape (0, 3): its vertices are
    its joints. `joints` are those of a skeleton, with or without a mesh, or None. `gltf` are the parts of a glTF whose
    one take this is, and whose nodes and skins can show it, or None.
    Frames are integers from 0; frame i is at `start_seconds` + i / `frame_rate` on the file's clock.
    A notebook shows it as poses at even distances of time.
    """

    vertices: Vertices
    vertex_count: int
    triangles: Int[np.ndarray, "T 3"]
    rest: Float[np.ndarray, "V 3"] | None
    frames: int
    frame_rate: float
    take: Take
    start_seconds: float = 0.0
    gltf: Mapping[str, memoryview] | None = None
    notices: tuple[Notice, ...] = field(default=())
    joints: Joints | None = None

    def seconds(self, frame: int) -> float:
        """The time of a frame, on the file's own clock."""
        return self.start_seconds + frame / self.frame_rate

    def __repr__(self) -> str:
        body = f"{self.vertex_count} vertices in {len(self.triangles)} triangles"
        return f"<Animation {self.take.name!r}: {self.frames} frames at {self.frame_rate:g} a second, {body}>"

    def _repr_html_(self) -> str:
        from caesura.core.plot.poses import draw_poses  # noqa: PLC0415  only a notebook needs it

        shown = np.linspace(0, self.frames - 1, min(SHOWN_POSES, self.frames)).round().astype(np.int64)
        poses = np.concatenate([self.vertices(frame, frame + 1) for frame in shown.tolist()])
        picture = draw_poses(poses, self.triangles, upright=None if self.gltf is None else 1)
        frames = ", ".join(map(str, shown.tolist()))
        image = f'<img alt="Poses at the frames {frames}" src="data:image/png;base64,{b64encode(picture).decode()}">'
        return f"<p>{escape(repr(self)[1:-1])}</p><p>{image}</p><p>Frames {frames}</p>"
