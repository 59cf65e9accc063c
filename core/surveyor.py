"""What is measured on a block of frames, while it is in the cache."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, UInt16

from core.animation import Animation
from core.basis import Basis
from core.blocks import Block
from core.body import Body
from core.buffers import Buffers
from core.codes import Coding
from core.descriptors.kernels import WIDTH
from core.descriptors.strain import TriangleStrain, UnreadableError
from core.drawing import draw
from core.histograms import Histograms


@dataclass(frozen=True)
class Page:
    """One block of frames, measured: what is compared over the take, and what is kept of every frame."""

    largest: float
    above_noise: int
    widest: float
    described: tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Surveyor:
    """Measures a block of frames. Safe from several threads. Codes below `floor` are not told apart in histograms."""

    animation: Animation
    body: Body
    reach: float
    coding: Coding
    floor: int
    noise: Float32[np.ndarray, "columns"]
    projections: Basis | None
    kept: UInt16[np.ndarray, "codes"]
    histograms: Histograms

    def keeps(self, block: Block) -> bool:
        """Whether the codes of the block are kept: those of the first frames are, as many as there is memory for."""
        return block[1] * self.body.surface.columns <= len(self.kept)

    def place(self, block: Block) -> UInt16[np.ndarray, "columns frames"]:
        """Where the codes of a block are that is kept. One piece of memory holds all: many would be cleared singly."""
        columns = self.body.surface.columns
        return self.kept[block[0] * columns : block[1] * columns].reshape(columns, block[1] - block[0])

    def measure(self, block: Block) -> Page:
        """Draw the block, and read every tile of its strain while it is in the cache."""
        vertices = draw(self.animation, block, checked=self._checks)
        means, histogram = self.body.patches.empty(len(vertices)), self.histograms.take()
        kept = self.place(block) if self.keeps(block) else np.empty((0, len(vertices)), np.uint16)
        try:
            largest, above = self._read(vertices, means, kept, histogram)
        except UnreadableError:
            draw(self.animation, block)  # says where
            raise
        self.histograms.give(histogram)
        apart = self.body.pairs.measure(vertices)
        described = (means.T, apart)
        if self.projections is not None:
            described = (self.projections[0].project(means.T), self.projections[1].project(apart))
        return Page(largest, above, float(np.abs(apart).max(initial=0)), described)

    def _read(
        self, vertices: np.ndarray, means: np.ndarray, kept: np.ndarray, histogram: np.ndarray
    ) -> tuple[float, int]:
        """The largest value and how many are above noise: in one call for strain, else tile by tile."""
        surface, patches = self.body.surface, self.body.patches
        if isinstance(surface, TriangleStrain) and len(vertices) <= WIDTH:
            coding = self.coding.lowest, np.int32(self.floor)
            return surface.read(vertices, self.noise, coding, (patches, means), kept, histogram)
        largest, above = 0.0, 0
        for columns, tile in surface.tiles(vertices):
            if patches.patches:
                patches.add(columns, tile, means)
            most, more = self.coding.read(tile, self.noise[columns], self.floor, kept[columns], histogram)
            largest, above = max(largest, most), above + more
        return largest, above

    @property
    def _checks(self) -> bool:
        """Whether measuring looks at every coordinate: a pass less over the vertices."""
        return isinstance(self.body.surface, TriangleStrain) and self.body.surface.covers

    def codes(self, block: Block, buffers: Buffers) -> UInt16[np.ndarray, "columns frames"]:
        """The codes of the block: as kept, or from the vertices, drawn again."""
        if self.keeps(block):
            return self.place(block)
        vertices = draw(self.animation, block, checked=True)
        codes = buffers.empty((self.body.surface.columns, len(vertices)), np.uint16)
        for columns, tile in self.body.surface.tiles(vertices):
            self.coding.encode(tile, codes[columns])
        return codes
