"""The pass over the vertices: every block of frames measured, and all of them as one, in block order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int, UInt8

from caesura.core.animation import Animation
from caesura.core.block_pass.block_statistics import BlockPass, BlockStatistics
from caesura.core.block_pass.features import learn_feature_basis
from caesura.core.block_pass.histograms import ThreadHistograms
from caesura.core.block_pass.measured_body import MeasuredBody
from caesura.core.block_pass.quantisation import Quantisation, find_normalising_strain
from caesura.core.block_pass.range_estimate import RangeEstimate
from caesura.core.descriptors.strain import ROUNDING
from caesura.core.frames.blocks import Block, frames_per_block, map_blocks, split_into_blocks, threads_at_once
from caesura.core.kernels.counting import look_up
from caesura.core.parameters import Parameters
from caesura.core.progress import Progress, ignore_progress

STILL_SHARE = 1e-6
"""A body does not strain where no more than this share of its strains, over all frames, rises above rounding."""


@dataclass(frozen=True)
class PassResult:
    """The whole take, measured, on so many threads.

    `largest` is the largest strain, `widest` the largest change of a pair distance.
    """

    block_pass: BlockPass
    blocks: list[Block]
    threads: int
    histogram: Int[np.ndarray, "codes"]
    largest: float
    above_noise: int
    widest: float
    described: tuple[np.ndarray, np.ndarray]

    @property
    def has_strain(self) -> bool:
        """Whether strain is more than rounding."""
        return self.share_above_noise > STILL_SHARE

    @property
    def share_above_noise(self) -> float:
        """The share of all strains that are more than rounding."""
        return self.above_noise / max(int(self.histogram.sum()), 1)

    @property
    def has_pair_changes(self) -> bool:
        """Whether pair distances change by more than rounding."""
        return self.widest * self.block_pass.body.pairs.size > ROUNDING * self.block_pass.reach

    def scale(self, rule: str | float) -> float:
        """The strain that counts as 1; noise has none to count."""
        share = self.share_above_noise if self.has_strain else 0.0
        return find_normalising_strain(rule, self.block_pass.coding, self.histogram, self.largest, share)

    def bins(
        self, scale: float, levels: int, progress: Progress = ignore_progress
    ) -> Iterator[UInt8[np.ndarray, "frames columns"]]:
        """The bin of every strain where so many of them part `scale`, in blocks of frames.

        φ1 = [0, 1/B], φi = ((i−1)/B, i/B]; what is above `scale` is in the last. From the codes where they were
        kept, else from the vertices, drawn once more.
        """
        bin_of_code = self.block_pass.coding.bins(scale, levels)

        def bins(block: Block) -> np.ndarray:
            codes = self.block_pass.codes(block)
            found = np.empty(codes.shape, np.uint8)
            look_up(codes, bin_of_code, found)
            return found

        return map_blocks(bins, self.blocks, self.threads, progress=progress, stage="energy", total=len(self.blocks))


def run_block_pass(
    animation: Animation,
    body: MeasuredBody,
    parameters: Parameters,
    *,
    threads: int = 1,
    progress: Progress = ignore_progress,
    memory_bytes: int,
) -> PassResult:
    """Measure every frame once, or again where the frames looked at beforehand were nothing like the rest.

    The codes are kept where all of them fit into `memory_bytes`.
    """
    glance = RangeEstimate.at(animation, body.surface)
    coding = Quantisation.around(glance.strain)
    surveyor = BlockPass(
        animation,
        body,
        glance.reach,
        coding,
        int(coding.encode(np.full(1, glance.common, np.float32))[0]),
        body.surface.noise(glance.reach),
        learn_feature_basis(animation, body, threads, progress),
        np.empty(min(animation.frames * body.surface.columns, memory_bytes // 2), np.uint16),
        ThreadHistograms(),
    )
    blocks = split_into_blocks(animation.frames, frames_per_block(animation.vertex_count))
    together = threads_at_once(threads, animation.vertex_count, body.surface.columns)
    while True:
        pages = map_blocks(surveyor.measure, blocks, together, progress=progress, stage="strain", total=len(blocks))
        take = _combine(surveyor, blocks, together, pages)
        better = _better_quantisation(take, parameters)
        if better is None:
            return take
        surveyor = replace(surveyor, coding=better, floor=0, histograms=ThreadHistograms())


def _better_quantisation(take: PassResult, parameters: Parameters) -> Quantisation | None:
    """The coding with which the bins of the take come out right, if its own is not that, or counts from too high."""
    coding, counts, rule = take.block_pass.coding, take.histogram, parameters.normalize
    if rule == "p99.9" and take.has_strain:
        if not coding.reaches_percentile(counts):
            return coding.wider()
        if take.block_pass.floor and not coding.tells_percentile(counts):
            return coding
    scale = take.scale(rule)
    better = Quantisation.around(scale)
    return None if better == coding or coding.tells_edges(scale, parameters.bins, counts) else better


def _combine(surveyor: BlockPass, blocks: list[Block], threads: int, measured: Iterable[BlockStatistics]) -> PassResult:
    """The pages of a take, in order, as one."""
    pages = list(measured)
    return PassResult(
        surveyor,
        blocks,
        threads,
        surveyor.histograms.total(),
        max(page.largest for page in pages),
        sum(page.above_noise for page in pages),
        max(page.widest for page in pages),
        (np.concatenate([page.described[0] for page in pages]), np.concatenate([page.described[1] for page in pages])),
    )
