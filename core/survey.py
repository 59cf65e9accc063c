"""The pass over the vertices: everything that is measured on a block of frames, and its reduction in block order."""

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float32, Int, UInt8, UInt16

from core import kernels
from core.animation import Animation
from core.basis import Basis, basis
from core.blocks import Block, blocks_of, frames_per_block, map_blocks
from core.body import Body
from core.buffers import Buffers
from core.codes import CODES, Coding
from core.descriptors.strain import ROUNDING, TriangleStrain, UnreadableError
from core.drawing import draw
from core.glance import Glance
from core.progress import Progress, ignore

STILL_SHARE = 1e-6
"""A body does not strain where no more than this share of its strains, over all frames, rises above rounding."""


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
    histograms: "Histograms"

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
        largest, above = 0.0, 0
        kept = self.place(block) if self.keeps(block) else np.empty((0, len(vertices)), np.uint16)
        try:
            for columns, tile in self.body.surface.tiles(vertices):
                if self.body.patches.patches:
                    self.body.patches.add(columns, tile, means)
                most, more = self.coding.read(tile, self.noise[columns], self.floor, kept[columns], histogram)
                largest, above = max(largest, most), above + more
        except UnreadableError:
            draw(self.animation, block)  # says where
            raise
        self.histograms.give(histogram)
        apart = self.body.pairs.measure(vertices)
        described = (means.T, apart)
        if self.projections is not None:
            described = (self.projections[0].project(means.T), self.projections[1].project(apart))
        return Page(largest, above, float(np.abs(apart).max(initial=0)), described)

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


@dataclass(frozen=True)
class Survey:
    """The whole take, measured. `largest` is the largest strain, `widest` the largest change of a pair distance."""

    surveyor: Surveyor
    blocks: list[Block]
    histogram: Int[np.ndarray, "codes"]
    largest: float
    above_noise: int
    widest: float
    described: tuple[np.ndarray, np.ndarray]

    @property
    def strains(self) -> bool:
        """Whether strain is more than rounding."""
        return self.share_above_noise > STILL_SHARE

    @property
    def share_above_noise(self) -> float:
        """The share of all strains that are more than rounding."""
        return self.above_noise / max(int(self.histogram.sum()), 1)

    @property
    def bends(self) -> bool:
        """Whether pair distances change by more than rounding."""
        return self.widest * self.surveyor.body.pairs.size > ROUNDING * self.surveyor.reach

    def bins(
        self, scale: float, levels: int, threads: int = 1, progress: Progress = ignore
    ) -> Iterator[UInt8[np.ndarray, "columns _"]]:
        """The bin of every strain over `scale`, φ1 = [0, 1/B], φi = ((i−1)/B, i/B], as 0 … B−1, in blocks of frames.

        From the codes where they were kept, else from the vertices, drawn once more.
        """
        edges = self.surveyor.coding.edges(scale, levels)
        edges = np.concatenate([edges, np.full(-len(edges) % 3, CODES - 1, np.uint16)])  # which no code is above

        buffers = Buffers()

        def digitized(block: Block) -> np.ndarray:
            codes = self.surveyor.codes(block, buffers)
            bins = buffers.empty(codes.shape, np.uint8)
            kernels.digitize(codes, edges, bins)
            return bins

        return map_blocks(digitized, self.blocks, threads, progress=progress, stage="energy", total=len(self.blocks))


class Histograms:
    """Counts of codes for as many threads as ask: integers, whose sum is the same in any order."""

    def __init__(self) -> None:
        self._free: deque[np.ndarray] = deque()

    def take(self) -> Int[np.ndarray, "codes"]:
        """Counts to add to, nobody else's until they are given back."""
        try:
            return self._free.pop()
        except IndexError:
            return np.zeros(CODES, np.int64)

    def give(self, counts: Int[np.ndarray, "codes"]) -> None:
        """Give them back."""
        self._free.append(counts)

    def total(self) -> Int[np.ndarray, "codes"]:
        """The sum of all that was given back."""
        return np.asarray(sum(self._free, np.zeros(CODES, np.int64)))


def survey(
    animation: Animation, body: Body, *, threads: int = 1, progress: Progress = ignore, memory_bytes: int
) -> Survey:
    """Measure every frame once. The codes are kept where all of them fit into `memory_bytes`."""
    glance = Glance.at(animation, body.surface)
    coding = Coding.around(glance.strain)
    surveyor = Surveyor(
        animation,
        body,
        glance.reach,
        coding,
        int(coding.encode(np.full((1, 1), glance.common, np.float32))[0, 0]),
        body.surface.noise(glance.reach),
        basis(animation, body, threads, progress),
        np.empty(min(animation.frames * body.surface.columns, memory_bytes // 2), np.uint16),
        Histograms(),
    )
    blocks = blocks_of(animation.frames, frames_per_block(animation.vertex_count))

    def taken(by: Surveyor) -> Survey:
        pages = map_blocks(by.measure, blocks, threads, progress=progress, stage="strain", total=len(blocks))
        return _bound(by, blocks, pages)

    take = taken(surveyor)
    while not coding.reaches_percentile(take.histogram):  # where the frames looked at were nothing like the rest
        coding = coding.wider()
        take = taken(replace(surveyor, coding=coding, floor=0, histograms=Histograms()))
    if take.surveyor.floor == 0 or coding.tells_percentile(take.histogram):
        return take
    return taken(replace(surveyor, floor=0, histograms=Histograms()))


def _bound(surveyor: Surveyor, blocks: list[Block], measured: Iterable[Page]) -> Survey:
    """The pages of a take, in order, as one."""
    pages = list(measured)
    return Survey(
        surveyor,
        blocks,
        surveyor.histograms.total(),
        max(page.largest for page in pages),
        sum(page.above_noise for page in pages),
        max(page.widest for page in pages),
        (np.concatenate([page.described[0] for page in pages]), np.concatenate([page.described[1] for page in pages])),
    )
