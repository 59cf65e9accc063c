"""The pass over the vertices: every block of frames measured, and all of them as one, in block order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int, UInt8

from caesura.core.animation import Animation
from caesura.core.block_pass.block_statistics import Page, Surveyor
from caesura.core.block_pass.features import basis
from caesura.core.block_pass.histograms import Histograms
from caesura.core.block_pass.measured_body import Body
from caesura.core.block_pass.quantisation import Coding, normaliser
from caesura.core.block_pass.range_estimate import Glance
from caesura.core.descriptors.strain import ROUNDING
from caesura.core.frames.blocks import Block, blocks_of, frames_per_block, map_blocks, threads_at_once
from caesura.core.kernels.counting import look_up
from caesura.core.parameters import Parameters
from caesura.core.progress import Progress, ignore

STILL_SHARE = 1e-6
"""A body does not strain where no more than this share of its strains, over all frames, rises above rounding."""


@dataclass(frozen=True)
class Survey:
    """The whole take, measured, on so many threads.

    `largest` is the largest strain, `widest` the largest change of a pair distance.
    """

    surveyor: Surveyor
    blocks: list[Block]
    threads: int
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

    def scale(self, rule: str | float) -> float:
        """The strain that counts as 1; noise has none to count."""
        share = self.share_above_noise if self.strains else 0.0
        return normaliser(rule, self.surveyor.coding, self.histogram, self.largest, share)

    def bins(
        self, scale: float, levels: int, progress: Progress = ignore
    ) -> Iterator[UInt8[np.ndarray, "frames columns"]]:
        """The bin of every strain where so many of them part `scale`, in blocks of frames.

        φ1 = [0, 1/B], φi = ((i−1)/B, i/B]; what is above `scale` is in the last. From the codes where they were
        kept, else from the vertices, drawn once more.
        """
        bin_of_code = self.surveyor.coding.bins(scale, levels)

        def bins(block: Block) -> np.ndarray:
            codes = self.surveyor.codes(block)
            found = np.empty(codes.shape, np.uint8)
            look_up(codes, bin_of_code, found)
            return found

        return map_blocks(bins, self.blocks, self.threads, progress=progress, stage="energy", total=len(self.blocks))


def survey(
    animation: Animation,
    body: Body,
    parameters: Parameters,
    *,
    threads: int = 1,
    progress: Progress = ignore,
    memory_bytes: int,
) -> Survey:
    """Measure every frame once, or again where the frames looked at beforehand were nothing like the rest.

    The codes are kept where all of them fit into `memory_bytes`.
    """
    glance = Glance.at(animation, body.surface)
    coding = Coding.around(glance.strain)
    surveyor = Surveyor(
        animation,
        body,
        glance.reach,
        coding,
        int(coding.encode(np.full(1, glance.common, np.float32))[0]),
        body.surface.noise(glance.reach),
        basis(animation, body, threads, progress),
        np.empty(min(animation.frames * body.surface.columns, memory_bytes // 2), np.uint16),
        Histograms(),
    )
    blocks = blocks_of(animation.frames, frames_per_block(animation.vertex_count))
    together = threads_at_once(threads, animation.vertex_count, body.surface.columns)
    while True:
        pages = map_blocks(surveyor.measure, blocks, together, progress=progress, stage="strain", total=len(blocks))
        take = _bound(surveyor, blocks, together, pages)
        better = _better(take, parameters)
        if better is None:
            return take
        surveyor = replace(surveyor, coding=better, floor=0, histograms=Histograms())


def _better(take: Survey, parameters: Parameters) -> Coding | None:
    """The coding with which the bins of the take come out right, if its own is not that, or counts from too high."""
    coding, counts, rule = take.surveyor.coding, take.histogram, parameters.normalize
    if rule == "p99.9" and take.strains:
        if not coding.reaches_percentile(counts):
            return coding.wider()
        if take.surveyor.floor and not coding.tells_percentile(counts):
            return coding
    scale = take.scale(rule)
    better = Coding.around(scale)
    return None if better == coding or coding.tells_edges(scale, parameters.bins, counts) else better


def _bound(surveyor: Surveyor, blocks: list[Block], threads: int, measured: Iterable[Page]) -> Survey:
    """The pages of a take, in order, as one."""
    pages = list(measured)
    return Survey(
        surveyor,
        blocks,
        threads,
        surveyor.histograms.total(),
        max(page.largest for page in pages),
        sum(page.above_noise for page in pages),
        max(page.widest for page in pages),
        (np.concatenate([page.described[0] for page in pages]), np.concatenate([page.described[1] for page in pages])),
    )
