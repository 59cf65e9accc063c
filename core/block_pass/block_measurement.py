"""Measures one block of frames while it is in the cache."""

from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from threading import Lock

import numpy as np
from jaxtyping import Float32, Int, UInt16

from caesura.core.animation import Animation
from caesura.core.block_pass.features import FeatureBasis
from caesura.core.block_pass.measured_body import MeasuredBody
from caesura.core.block_pass.quantisation import CODES, Quantisation
from caesura.core.frames.blocks import Block
from caesura.core.frames.sampled_frames import read_vertices


@dataclass(frozen=True)
class BlockStatistics:
    """One block of frames, measured: what is compared over the take, and what is kept of every frame."""

    largest: float
    above_noise: int
    largest_pair_change: float
    features: tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class BlockPass:
    """Measures a block of frames. Safe from several threads. Codes below `floor` are not told apart in `histogram`."""

    animation: Animation
    body: MeasuredBody
    reach: float
    quantisation: Quantisation
    floor: int
    noise: Float32[np.ndarray, "columns"]
    projections: FeatureBasis | None
    kept: UInt16[np.ndarray, "kept"]
    histogram: Int[np.ndarray, "codes"]
    lock: AbstractContextManager[bool] = field(default_factory=Lock)

    def measure(self, block: Block) -> BlockStatistics:
        """Read the block, and measure it tile by tile."""
        vertices = read_vertices(self.animation, block)
        means, histogram = self.body.patches.empty(len(vertices)), np.zeros(CODES, np.int64)
        codes = self._kept(block)
        largest, above = 0.0, 0
        for columns, tile in self.body.surface.tiles(vertices):
            self.body.patches.add(columns, tile, means)
            most, more = self.quantisation.count(tile, self.noise[columns], self.floor, histogram)
            largest, above = max(largest, most), above + more
            if codes is not None:
                self.quantisation.write(tile, codes, columns.start)
        with self.lock:
            np.add(self.histogram, histogram, out=self.histogram)
        apart = self.body.pairs.measure(vertices)
        described = (means.T, apart)
        if self.projections is not None:
            described = (self.projections[0].project(means.T), self.projections[1].project(apart))
        return BlockStatistics(largest, above, float(np.abs(apart).max(initial=0)), described)

    def codes(self, block: Block) -> UInt16[np.ndarray, "frames columns"]:
        """The codes of the block: as kept, or from the vertices, drawn again."""
        codes = self._kept(block)
        if codes is None:
            codes = np.empty((block[1] - block[0], self.body.surface.columns), np.uint16)
            vertices = np.ascontiguousarray(self.animation.vertices(*block), np.float32)  # checked the first time
            for columns, tile in self.body.surface.tiles(vertices):
                self.quantisation.write(tile, codes, columns.start)
        return codes

    def _kept(self, block: Block) -> UInt16[np.ndarray, "frames columns"] | None:
        """Where the codes of the block are kept: those of the first frames are, as many as there is memory for.

        One piece of memory holds all: many would be cleared singly.
        """
        columns = self.body.surface.columns
        if block[1] * columns > len(self.kept):
            return None
        return self.kept[block[0] * columns : block[1] * columns].reshape(block[1] - block[0], columns)
