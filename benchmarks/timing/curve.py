"""The energy curve alone, from vertices in memory: the pipeline's steps without the features."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Float

from caesura.core.animation import Animation
from caesura.core.block_pass.descriptor_set import NO_PATCHES, DescriptorSet
from caesura.core.block_pass.quantisation import CODES
from caesura.core.block_pass.rest_pose import compute_rest_pose
from caesura.core.block_pass.vertex_pass import PassResult, run_block_pass
from caesura.core.energy.energy_curve import compute_energy_curve, frames_per_window
from caesura.core.frames.blocks import frames_per_block, split_into_blocks
from caesura.core.frames.sampled_frames import read_vertices
from caesura.core.parameters import Parameters
from caesura.core.pipeline import CODES_BYTES

LEVELS = 10


@dataclass(frozen=True)
class Curve:
    """One take, prepared. `memory_bytes` 0 computes strain twice."""

    animation: Animation
    threads: int = 2
    memory_bytes: int = CODES_BYTES

    @cached_property
    def whole(self) -> DescriptorSet:
        """All that the pipeline measures."""
        return DescriptorSet.of(self.animation, compute_rest_pose(self.animation, "bind"), Parameters())[0]

    @cached_property
    def bare(self) -> DescriptorSet:
        """Strain, and nothing else."""
        pairs = self.whole.pairs
        none = replace(pairs, first=pairs.first[:0], second=pairs.second[:0], at_rest=pairs.at_rest[:0])
        return replace(self.whole, patches=NO_PATCHES, pairs=none)

    @property
    def window(self) -> int:
        """Frames of a window."""
        return frames_per_window("modified", Parameters().window_seconds, self.animation.frame_rate)

    def surveyed(self) -> PassResult:
        """The pass over the vertices."""
        memory = self.memory_bytes
        return run_block_pass(self.animation, self.bare, Parameters(), threads=self.threads, memory_bytes=memory)

    def scale(self, take: PassResult) -> float:
        """The strain that counts as 1."""
        return take.scale(Parameters().normalize)

    def energy(self) -> Float[np.ndarray, "frames"]:
        """The curve."""
        take = self.surveyed()
        bins = take.bins(self.scale(take), LEVELS)
        return compute_energy_curve(bins, self.animation.frames, self.window, LEVELS, take.threads)

    def stages(self) -> dict[str, Callable[[], object]]:
        """Each step of a whole analysis's passes by itself, over the whole take, on one thread."""
        take, body = self.surveyed(), self.whole
        blocks = split_into_blocks(self.animation.frames, frames_per_block(self.animation.vertex_count))
        scale, surface = self.scale(take), body.surface
        bins = list(take.bins(scale, LEVELS))
        drawn = [self.animation.vertices(*block) for block in blocks]
        histogram, noise, floor = np.zeros(CODES, np.int64), take.block_pass.noise, take.block_pass.floor
        columns, tile = max(((c, t.copy()) for c, t in surface.tiles(drawn[0])), key=lambda pair: pair[1].size)
        codes, means = np.empty(tile.shape, np.uint16), body.patches.empty(len(drawn[0]))
        times = range(self.animation.frames * surface.columns // tile.size)

        def code_and_count() -> None:
            for _ in times:
                take.block_pass.quantisation.count(tile, noise[columns], floor, histogram)
                take.block_pass.quantisation.write(tile, codes)

        def look_up_bins() -> None:
            for _ in take.bins(scale, LEVELS):
                pass

        def means_on_patches() -> None:
            for _ in times:
                body.patches.add(columns, tile, means)

        return {
            "check that every coordinate is a number": lambda: [
                read_vertices(self.animation, block) for block in blocks
            ],
            "gather vertices, strain": lambda: [0 for vertices in drawn for _ in surface.tiles(vertices)],
            "code, count codes": code_and_count,
            "bins": look_up_bins,
            "joint counts, entropy": lambda: compute_energy_curve(bins, self.animation.frames, self.window, LEVELS),
            "means on patches": means_on_patches,
            "pair distances": lambda: [body.pairs.measure(vertices) for vertices in drawn],
        }
