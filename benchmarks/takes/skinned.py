"""A skinned file of a game's fineness: from its bytes to the energy curve, and the same from sampled vertices."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchmarks.takes.fine_figure import fine_figure
from benchmarks.timing.curve import Curve
from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.read import read_animation

SAMPLED_AT_ONCE = 64


@dataclass(frozen=True)
class Skinned:
    """The bytes of a file, and its take with every vertex sampled beforehand."""

    file: bytes
    sampled: Animation

    @classmethod
    def made(cls) -> "Skinned":
        """1,047 frames of some 34,000 vertices."""
        file = fine_figure()
        read = _read(file)
        vertices = np.empty((read.frames, read.vertex_count, 3), np.float32)
        for start in range(0, read.frames, SAMPLED_AT_ONCE):
            stop = min(start + SAMPLED_AT_ONCE, read.frames)
            vertices[start:stop] = read.vertices(start, stop)
        animation = Animation(
            lambda start, stop: vertices[start:stop],
            read.vertex_count,
            read.triangles,
            read.rest,
            read.frames,
            read.frame_rate,
            read.take,
        )
        return cls(file, animation)

    def ways(self) -> dict[str, Callable[[], object]]:
        """The curve from the bytes, and from the vertices."""
        return {
            "file": lambda: Curve(_read(self.file)).energy(),
            "vertices": lambda: Curve(self.sampled).energy(),
        }


def _read(file: bytes) -> Animation:
    return read_animation({"figure.glb": file}, Parameters(), Limits.none(), lambda size: memoryview(bytearray(size)))
