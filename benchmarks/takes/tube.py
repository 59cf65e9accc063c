"""A bending tube of any size in memory: what speed is measured on."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Int

from caesura.core.animation import Animation, Take

FRAME_RATE = 30.0
LENGTH, RADIUS = 8.0, 0.5
JOINTS = np.array([1.5, 3.5, 5.0, 6.5])
DISTINCT_BYTES = 160 * 2**20
"""Longer takes repeat their first frames, so that what is held stays far above every cache and far below memory."""


@dataclass(frozen=True)
class Tube:
    """`vertices` (distinct frames, V, 3), bent at four joints at paces of their own, and the triangles between them."""

    rest: Float32[np.ndarray, "V 3"]
    triangles: Int[np.ndarray, "T 3"]
    vertices: Float32[np.ndarray, "distinct V 3"]

    @classmethod
    def of(cls, frames: int, triangles: int, distinct_bytes: int = DISTINCT_BYTES) -> "Tube":
        """About so many triangles, ring by ring along the tube: coherent order."""
        around = max(int(np.sqrt(triangles / 8)), 8)
        rings = triangles // 2 // around + 1
        rest, faces = _rest(around, rings)
        distinct = min(frames, max(distinct_bytes // (12 * len(rest)) // 64 * 64, 64))
        vertices = np.empty((distinct, *rest.shape), np.float32)  # filled in place: no freed memory is left to reuse
        for frame in range(distinct):
            vertices[frame] = _bent(rest, frame)
        return cls(rest, faces, vertices)

    def animation(self, frames: int) -> Animation:
        """A take of so many frames, drawn without a copy."""

        def draw(start: int, stop: int) -> Float32[np.ndarray, "block V 3"]:
            first = start % len(self.vertices)
            if first + stop - start <= len(self.vertices):
                return self.vertices[first : first + stop - start]
            return self.vertices[np.arange(start, stop) % len(self.vertices)]

        take = Take(0, "tube", frames / FRAME_RATE, frames, FRAME_RATE)
        return Animation(draw, len(self.rest), self.triangles, self.rest, frames, FRAME_RATE, take)

    def shuffled(self) -> "Tube":
        """The same tube with its vertices in random order in memory."""
        order = np.random.default_rng(0).permutation(len(self.rest))
        place = np.argsort(order)
        return Tube(self.rest[order], place[self.triangles], np.ascontiguousarray(self.vertices[:, order]))


def _rest(around: int, rings: int) -> tuple[Float32[np.ndarray, "V 3"], Int[np.ndarray, "T 3"]]:
    along, angle = np.meshgrid(np.linspace(0, LENGTH, rings), np.arange(around) / around * 2 * np.pi, indexing="ij")
    rest = np.stack([RADIUS * np.cos(angle), RADIUS * np.sin(angle), along], axis=-1).reshape(-1, 3)
    ring, place = np.arange(rings - 1)[:, None] * around, np.arange(around)
    beside = (place + 1) % around
    a, b, c, d = (x.ravel() for x in (ring + place, ring + beside, ring + around + place, ring + around + beside))
    pairs = np.stack([np.stack([a, b, c], axis=1), np.stack([b, d, c], axis=1)], axis=1)
    return rest.astype(np.float32), pairs.reshape(-1, 3)


def _bent(rest: Float32[np.ndarray, "V 3"], frame: int) -> Float32[np.ndarray, "V 3"]:
    """The tube with its axis turned smoothly at every joint; cross-sections stay flat and breathe a little."""
    turns = 0.45 * np.sin(frame * np.array([0.031, 0.047, 0.083, 0.059]) + np.arange(4))
    fine = np.linspace(0, LENGTH, 512)
    angles = (turns / (1 + np.exp(-4 * (fine[:, None] - JOINTS)))).sum(axis=1)
    step = LENGTH / (len(fine) - 1)
    x, y, along = rest.T.astype(np.float64)
    angle = np.interp(along, fine, angles)
    breath = 1 + 0.03 * np.sin(0.1 * frame)
    height = np.interp(along, fine, np.cumsum(np.sin(angles)) * step) + breath * y * np.cos(angle)
    depth = np.interp(along, fine, np.cumsum(np.cos(angles)) * step) - y * np.sin(angle)
    return np.stack([breath * x, height, depth], axis=1).astype(np.float32)
