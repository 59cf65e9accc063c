"""The pass over the vertices: everything that is measured on a block of frames, and its reduction in block order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float32, Int, UInt8, UInt16

from core import kernels
from core.animation import Animation
from core.basis import Basis, basis
from core.blocks import Block, blocks_of, frames_per_block, map_blocks
from core.body import Body
from core.codes import CODES, Coding
from core.descriptors.strain import ROUNDING
from core.drawing import draw
from core.glance import Glance
from core.progress import Progress, ignore

STILL_SHARE = 1e-6
"""A body does not strain where no more than this share of its strains, over all frames, rises above rounding."""


@dataclass(frozen=True)
class Page:
    """One block of frames, measured: codes where they are kept, and what is summed or compared over the take."""

    codes: UInt16[np.ndarray, "columns frames"] | None
    histogram: Int[np.ndarray, "codes"]
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
    keep_codes: bool
    projections: Basis | None

    def measure(self, block: Block) -> Page:
        """Draw the block, and read every tile of its strain while it is in the cache."""
        vertices = draw(self.animation, block)
        means, histogram = self.body.patches.empty(len(vertices)), np.zeros(CODES, np.int32)
        largest, above = 0.0, 0
        kept = np.empty((self.body.surface.columns if self.keep_codes else 0, len(vertices)), np.uint16)
        for columns, tile in self.body.surface.tiles(vertices):
            if self.body.patches.patches:
                self.body.patches.add(columns, tile, means)
            codes = kept[columns] if self.keep_codes else np.empty(tile.shape, np.uint16)
            most, more = self.coding.read(tile, self.noise[columns], self.floor, codes, histogram)
            largest, above = max(largest, most), above + more
        apart = self.body.pairs.measure(vertices)
        described = (means.T, apart)
        if self.projections is not None:
            described = (self.projections[0].project(means.T), self.projections[1].project(apart))
        widest = float(np.abs(apart).max(initial=0))
        kept_codes = kept if self.keep_codes else None
        return Page(kept_codes, histogram, largest, above, widest, described)

    def codes(self, block: Block) -> UInt16[np.ndarray, "columns frames"]:
        """The codes of the block, drawn again."""
        vertices = draw(self.animation, block)
        codes = np.empty((self.body.surface.columns, len(vertices)), np.uint16)
        for columns, tile in self.body.surface.tiles(vertices):
            self.coding.encode(tile, codes[columns])
        return codes


@dataclass(frozen=True)
class Survey:
    """The whole take, measured. `largest` is the largest strain, `widest` the largest change of a pair distance."""

    surveyor: Surveyor
    blocks: list[Block]
    codes: list[UInt16[np.ndarray, "columns _"]] | None
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

        def digitized(source: Block | np.ndarray) -> np.ndarray:
            codes = self.surveyor.codes(source) if isinstance(source, tuple) else source
            bins = np.empty(codes.shape, np.uint8)
            kernels.digitize(codes, edges, bins)
            return bins

        sources: Iterable[Block | np.ndarray] = self.blocks if self.codes is None else self.codes
        return map_blocks(digitized, sources, threads, progress=progress, stage="energy", total=len(self.blocks))


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
        2 * animation.frames * body.surface.columns <= memory_bytes,
        basis(animation, body, threads, progress),
    )
    blocks = blocks_of(animation.frames, frames_per_block(animation.vertex_count))

    def taken(by: Surveyor) -> Survey:
        pages = map_blocks(by.measure, blocks, threads, progress=progress, stage="strain", total=len(blocks))
        return _bound(by, blocks, pages)

    take = taken(surveyor)
    if surveyor.floor == 0 or coding.tells_percentile(take.histogram):
        return take
    return taken(replace(surveyor, floor=0))  # the frames looked at were nothing like the rest


def _bound(surveyor: Surveyor, blocks: list[Block], pages: Iterable[Page]) -> Survey:
    """The pages of a take, in order, as one; only one histogram is held beside them."""
    histogram, above, widest, kept = np.zeros(CODES, np.int64), 0, 0.0, []
    for page in pages:
        histogram += page.histogram
        above += page.above_noise
        widest = max(widest, page.widest)
        kept.append(replace(page, histogram=histogram))
    return Survey(
        surveyor,
        blocks,
        [page.codes for page in kept if page.codes is not None] if surveyor.keep_codes else None,
        histogram,
        max(page.largest for page in kept),
        above,
        widest,
        (np.concatenate([page.described[0] for page in kept]), np.concatenate([page.described[1] for page in kept])),
    )
