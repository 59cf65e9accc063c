"""An animation as the method sees it: one triangulation, and vertices drawn by blocks of frames."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Int

from caesura.core.document import Notice


@runtime_checkable
class Vertices(Protocol):
    """Draws frames. Safe to call from several threads at once, and the same bytes at every call."""

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        """Positions of frames [start, stop), float32, C-contiguous, finite; a fresh array or a read-only view."""


@dataclass(frozen=True)
class Take:
    """One animation of the file. `index` is its place there; a vertex sequence is its own only take, index 0."""

    index: int
    name: str
    duration_seconds: float
    frames: int
    frame_rate: float


@dataclass(frozen=True)
class Animation:
    """A deforming mesh over time.

    `vertices(start, stop)` draws frames [start, stop) as float32 (block, V, 3); nothing holds all frames at once.
    `rest` is the undeformed shape the file itself names (bind pose, base mesh), or None where it names none
    (then the method takes frame 0). A skeleton without a mesh has `triangles` of shape (0, 3): its vertices are
    its joints. `gltf` are the parts of a glTF whose one take this is, and whose nodes and skins can show it, or None.
    Frames are integers from 0; frame i is at `start_seconds` + i / `frame_rate` on the file's clock.
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

    def seconds(self, frame: int) -> float:
        """The time of a frame, on the file's own clock."""
        return self.start_seconds + frame / self.frame_rate
