"""What is measured on a block of frames, while it is in the cache."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, UInt16

from core.animation import Animation
from core.basis import Basis
from core.blocks import Block
from core.body import NO_PATCHES, Body
from core.buffers import Buffers
from core.codes import CODES, Coding
from core.descriptors.patch_means import PatchMeans
from core.descriptors.strain import TriangleStrain, UnreadableError
from core.drawing import draw
from core.exceedance.kernels import WORD
from core.histograms import Histograms

Counted = tuple[int, np.ndarray]
"""The code from which on codes are counted, and their counts."""

_NOT_KEPT = np.empty((0, 0), np.uint16)
_COUNTED_BEFORE = np.empty(0, np.int64)


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

    @property
    def row(self) -> int:
        """Codes of a frame and room to whole words of bits, an odd number of them.

        Rows that lay a power of two apart would share a few lines of the cache.
        """
        return row_of(self.body.surface.columns)

    def keeps(self, block: Block) -> bool:
        """Whether the codes of the block are kept: those of the first frames are, as many as there is memory for."""
        return block[1] * self.row <= len(self.kept)

    def place(self, block: Block) -> UInt16[np.ndarray, "frames row"]:
        """Where the codes of a block are that is kept. One piece of memory holds all: many would be cleared singly."""
        return self.kept[block[0] * self.row : block[1] * self.row].reshape(-1, self.row)

    def measure(self, block: Block) -> Page:
        """Draw the block, and read every tile of its strain while it is in the cache."""
        vertices = draw(self.animation, block, checked=self._checks)
        means, histogram = self.body.patches.empty(len(vertices)), self.histograms.take()
        kept = self._cleared(self.place(block)) if self.keeps(block) else _NOT_KEPT
        try:
            largest, above = self._read(vertices, (self.body.patches, means), kept, (self.floor, histogram))
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
        self, vertices: np.ndarray, means: tuple[PatchMeans, np.ndarray], codes: np.ndarray, counted: Counted
    ) -> tuple[float, int]:
        """The largest value and how many are above noise: in one call for strain, else tile by tile."""
        surface, (patches, sums), (floor, histogram) = self.body.surface, means, counted
        if isinstance(surface, TriangleStrain):
            coding = self.coding.lowest, np.int32(floor)
            return surface.read(vertices, self.noise, coding, means, codes, histogram)
        largest, above = 0.0, 0
        for columns, tile in surface.tiles(vertices):
            if patches.patches:
                patches.add(columns, tile, sums)
            if len(histogram):
                most, more = self.coding.read(tile, self.noise[columns], floor, histogram)
                largest, above = max(largest, most), above + more
            if len(codes):
                self.coding.turn(tile, codes, columns.start)
        return largest, above

    @property
    def _checks(self) -> bool:
        """Whether measuring looks at every coordinate: a pass less over the vertices."""
        return isinstance(self.body.surface, TriangleStrain) and self.body.surface.covers

    def codes(self, block: Block, buffers: Buffers) -> UInt16[np.ndarray, "frames row"]:
        """The codes of the block: as kept, or from the vertices, drawn again."""
        if self.keeps(block):
            return self.place(block)
        vertices = draw(self.animation, block, checked=True)
        codes = self._cleared(buffers.empty((len(vertices), self.row), np.uint16))
        nothing = np.empty((0, len(vertices)), np.float32)
        self._read(vertices, (NO_PATCHES, nothing), codes, (CODES, _COUNTED_BEFORE))
        return codes

    def _cleared(self, codes: np.ndarray) -> np.ndarray:
        """Codes whose room beside the columns is 0, which exceeds nothing."""
        codes[:, self.body.surface.columns :] = 0
        return codes


def row_of(columns: int) -> int:
    """Codes in a row of so many columns: see `Surveyor.row`."""
    return (-(-columns // WORD) | 1) * WORD
