"""The pass over the vertices: every block of frames measured, and all of them as one, in block order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int, UInt8

from core import kernels
from core.animation import Animation
from core.basis import basis
from core.blocks import Block, blocks_of, frames_per_block, map_blocks
from core.body import Body
from core.buffers import Buffers
from core.codes import CODES, Coding
from core.descriptors.strain import ROUNDING
from core.glance import Glance
from core.histograms import Histograms
from core.progress import Progress, ignore
from core.surveyor import Page, Surveyor

STILL_SHARE = 1e-6
"""A body does not strain where no more than this share of its strains, over all frames, rises above rounding."""


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
