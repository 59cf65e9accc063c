"""The pass over the vertices: it measures every block of frames and combines the results in block order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float32, Int, UInt8

from caesura.core.animation import Animation
from caesura.core.block_pass.block_measurement import BlockMeasurement, BlockPass
from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.block_pass.features import learn_feature_basis
from caesura.core.block_pass.quantisation import CODES, Quantisation, find_normalising_strain
from caesura.core.block_pass.range_estimate import RangeEstimate
from caesura.core.frames.blocks import Block, frames_per_block, map_blocks, split_into_blocks, threads_at_once
from caesura.core.frames.sampled_frames import ROUNDING
from caesura.core.kernels.counting import look_up_bins
from caesura.core.parameters import Parameters
from caesura.core.progress import Progress, ignore_progress

STILL_SHARE = 1e-6
"""A body does not strain where no more than this share of its strains, over all frames, rises above rounding."""


@dataclass(frozen=True)
class PassResult:
    """The whole take, measured, on so many threads.

    `largest` is the largest strain, `largest_pair_change` the largest change of a pair distance.
    """

    block_pass: BlockPass
    blocks: list[Block]
    threads: int
    histogram: Int[np.ndarray, "codes"]
    largest: float
    above_noise: int
    largest_pair_change: float
    features: tuple[np.ndarray, ...]
    others_above_noise: tuple[int, ...] = ()

    @property
    def changing(self) -> tuple[bool, ...]:
        """Of each of `features`, whether it changes by more than rounding."""
        body, frames = self.block_pass.body, self.blocks[-1][1]
        others = (
            above > STILL_SHARE * frames * other.descriptor.columns
            for above, other in zip(self.others_above_noise, body.others, strict=True)
        )
        return (body.patches.patches > 0 and self.has_strain, *others, self.has_pair_changes)

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
        return self.largest_pair_change * self.block_pass.body.pairs.size > ROUNDING * self.block_pass.reach

    def scale(self, rule: str | float) -> float:
        """The strain that counts as 1; noise has none to count."""
        share = self.share_above_noise if self.has_strain else 0.0
        return find_normalising_strain(rule, self.block_pass.quantisation, self.histogram, self.largest, share)

    def bins(
        self, scale: float, levels: int, progress: Progress = ignore_progress
    ) -> Iterator[UInt8[np.ndarray, "columns frames"]]:
        """The bin of every strain where so many of them part `scale`, in blocks of frames.

        φ1 = [0, 1/B], φi = ((i−1)/B, i/B]; what is above `scale` is in the last. From the codes where they were
        kept, else from the vertices, drawn once more.
        """
        bin_of_code = self.block_pass.quantisation.bins(scale, levels)

        def bins(block: Block) -> np.ndarray:
            codes = self.block_pass.codes(block)
            found = np.empty(codes.shape, np.uint8)
            look_up_bins(codes, bin_of_code, found)
            return found

        return map_blocks(bins, self.blocks, self.threads, progress=progress, stage="energy", total=len(self.blocks))

    def normalised_strains(
        self, scale: float, progress: Progress = ignore_progress
    ) -> Iterator[Float32[np.ndarray, "frames columns"]]:
        """Every strain over `scale`, at most 1 and good to a part in 8,192, in blocks of frames."""
        shares = self.block_pass.quantisation.shares(scale)

        def strains(block: Block) -> np.ndarray:
            return np.asarray(shares[self.block_pass.codes(block).T])

        return map_blocks(strains, self.blocks, self.threads, progress=progress, stage="energy", total=len(self.blocks))


def run_block_pass(
    animation: Animation,
    body: DescriptorSet,
    parameters: Parameters,
    *,
    threads: int = 1,
    progress: Progress = ignore_progress,
    memory_bytes: int,
) -> PassResult:
    """Measure every frame once, or again where the frames looked at beforehand were nothing like the rest.

    The codes are kept where all of them fit into `memory_bytes`.
    """
    estimate = RangeEstimate.at(animation, body.surface)
    quantisation = Quantisation.for_largest(estimate.strain)
    block_pass = BlockPass(
        animation,
        body,
        estimate.reach,
        quantisation,
        int(quantisation.encode(np.full(1, estimate.common, np.float32))[0]),
        body.surface.noise(estimate.reach),
        learn_feature_basis(animation, body, threads, progress),
        np.empty(min(animation.frames * body.surface.columns, memory_bytes // 2), np.uint16),
        np.zeros(CODES, np.int64),
        tuple(other.descriptor.noise(estimate.reach) for other in body.others),
    )
    blocks = split_into_blocks(animation.frames, frames_per_block(animation.vertex_count))
    used_threads = threads_at_once(threads, animation.vertex_count, body.surface.columns)
    while True:
        statistics = map_blocks(
            block_pass.measure, blocks, used_threads, progress=progress, stage="strain", total=len(blocks)
        )
        take = _combine(block_pass, blocks, used_threads, statistics)
        better = _better_quantisation(take, parameters)
        if better is None:
            return take
        block_pass = replace(block_pass, quantisation=better, floor=0, histogram=np.zeros(CODES, np.int64))


def _better_quantisation(take: PassResult, parameters: Parameters) -> Quantisation | None:
    """The quantisation that the bins of the take need, if its own does not do or counts from too high a code."""
    quantisation, counts, rule = take.block_pass.quantisation, take.histogram, parameters.normalize
    if rule == "p99.9" and take.has_strain:
        if not quantisation.reaches_percentile(counts):
            return quantisation.wider()
        if take.block_pass.floor and not quantisation.resolves_percentile(counts):
            return quantisation
    scale = take.scale(rule)
    better = Quantisation.for_largest(scale)
    return None if better == quantisation or quantisation.resolves_edges(scale, parameters.bins, counts) else better


def _combine(
    block_pass: BlockPass, blocks: list[Block], threads: int, measured: Iterable[BlockMeasurement]
) -> PassResult:
    """The statistics of a take, in order, as one."""
    statistics = list(measured)
    return PassResult(
        block_pass,
        blocks,
        threads,
        block_pass.histogram,
        max(block.largest for block in statistics),
        sum(block.above_noise for block in statistics),
        max(block.largest_pair_change for block in statistics),
        tuple(np.concatenate(kind) for kind in zip(*(block.features for block in statistics), strict=True)),
        tuple(sum(above) for above in zip(*(block.others_above_noise for block in statistics), strict=True)),
    )
