"""Measures one block of frames while it is in the cache."""

from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from threading import Lock

import numpy as np
from jaxtyping import Float32, Int, UInt16

from caesura.core.animation import Animation
from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.block_pass.features import FeatureBasis
from caesura.core.block_pass.quantisation import CODES, Quantisation
from caesura.core.frames.blocks import Block
from caesura.core.frames.sampled_frames import read_vertices


@dataclass(frozen=True)
class BlockMeasurement:
    """One block of frames, measured: what is compared over the take, and what is kept of every frame."""

    largest: float
    above_noise: int
    largest_pair_change: float
    features: tuple[np.ndarray, ...]
    others_above_noise: tuple[int, ...] = ()
    """Values of each further descriptor that are more than rounding."""


@dataclass(frozen=True)
class BlockPass:
    """Measures a block of frames. Safe from several threads. Codes below `floor` are not told apart in `histogram`."""

    animation: Animation
    body: DescriptorSet
    reach: float
    quantisation: Quantisation
    floor: int
    noise: Float32[np.ndarray, "columns"]
    projections: FeatureBasis | None
    kept: UInt16[np.ndarray, "kept"]
    histogram: Int[np.ndarray, "codes"]
    others_noise: tuple[Float32[np.ndarray, "_"], ...] = ()
    lock: AbstractContextManager[bool] = field(default_factory=Lock)

    def measure(self, block: Block) -> BlockMeasurement:
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
                self.quantisation.write(tile, codes[columns])
        with self.lock:
            np.add(self.histogram, histogram, out=self.histogram)
        others, others_above = self._measure_others(vertices)
        apart = self.body.pairs.measure(vertices)
        described = (means.T, *others, apart)
        if self.projections is not None:
            described = tuple(one.project(values) for one, values in zip(self.projections, described, strict=True))
        return BlockMeasurement(largest, above, float(np.abs(apart).max(initial=0)), described, others_above)

    def _measure_others(
        self, vertices: Float32[np.ndarray, "frames V 3"]
    ) -> tuple[list[Float32[np.ndarray, "frames _"]], tuple[int, ...]]:
        """The patch means of every further descriptor, and how many of its values are more than rounding."""
        described, above = [], []
        for other, noise in zip(self.body.others, self.others_noise, strict=True):
            means, count = other.patches.empty(len(vertices)), 0
            for columns, tile in other.descriptor.tiles(vertices):
                other.patches.add(columns, tile, means)
                count += int(np.count_nonzero(tile > noise[columns, None]))
            described.append(means.T)
            above.append(count)
        return described, tuple(above)

    def codes(self, block: Block) -> UInt16[np.ndarray, "columns frames"]:
        """The codes of the block: as kept, or from the vertices, drawn again."""
        codes = self._kept(block)
        if codes is None:
            codes = np.empty((self.body.surface.columns, block[1] - block[0]), np.uint16)
            vertices = read_vertices(self.animation, block)
            for columns, tile in self.body.surface.tiles(vertices):
                self.quantisation.write(tile, codes[columns])
        return codes

    def _kept(self, block: Block) -> UInt16[np.ndarray, "columns frames"] | None:
        """Where the codes of the block are kept: those of the first frames are, as many as there is memory for.

        One piece of memory holds all: many would be cleared singly.
        """
        columns = self.body.surface.columns
        if block[1] * columns > len(self.kept):
            return None
        return self.kept[block[0] * columns : block[1] * columns].reshape(columns, block[1] - block[0])
