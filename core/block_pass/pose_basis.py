"""The basis of a body's poses: learnt from one take, it measures any take of the same body in the same numbers."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32, Int
from threadpoolctl import threadpool_limits

from caesura.core.analysis import Analysis
from caesura.core.animation import Animation
from caesura.core.block_pass.body_size import scale_to_rest_size
from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.block_pass.features import learn_from_sample
from caesura.core.block_pass.projection import Projection
from caesura.core.block_pass.rest_pose import compute_rest_pose
from caesura.core.errors import InvalidModel
from caesura.core.frames.blocks import Block, frames_per_block, map_blocks, split_into_blocks, threads_at_once
from caesura.core.frames.sampled_frames import read_vertices
from caesura.core.parameters import Parameters


@dataclass(frozen=True)
class PoseComponents:
    """One descriptor: `which` of what the body measures, its components, and their scale.

    All of its columns together are at unit mean square over the take that they were learnt from.
    """

    name: str
    which: int
    projection: Projection
    scale: float


@dataclass(frozen=True)
class PoseBasis:
    """What is measured of a body with these triangles, compared with one rest shape."""

    body: DescriptorSet
    triangles: Int[np.ndarray, "T 3"]
    vertex_count: int
    parts: tuple[PoseComponents, ...]
    rest: Float32[np.ndarray, "V 3"] | None = None
    """The rest shape, to whose size every frame is brought; None where the size counts too."""

    @classmethod
    def learn(
        cls, animation: Animation, parameters: Parameters, analysis: Analysis, *, threads: int = 1
    ) -> "PoseBasis":
        """The components of the take that `analysis` is of; a descriptor that does not change there has none."""
        with threadpool_limits(1):
            rest = compute_rest_pose(animation, parameters.rest)
            animation = scale_to_rest_size(animation, rest) if parameters.scale_invariant else animation
            body, _ = DescriptorSet.of(animation, rest, parameters)
            projections = learn_from_sample(animation, body, threads)
        parts = []
        for feature in analysis.features:
            which = body.names.index(feature.name)
            square = float(np.einsum("fd,fd->", feature.values, feature.values)) / analysis.frames
            if square > 0:
                parts.append(PoseComponents(feature.name, which, projections[which], 1 / np.sqrt(square)))
        size = rest if parameters.scale_invariant else None
        return cls(body, animation.triangles, animation.vertex_count, tuple(parts), size)

    @property
    def names(self) -> list[str]:
        """A name for every column: `strain0`, `strain1`, …"""
        return [
            f"{part.name.replace('-', '_')}{column}"
            for part in self.parts
            for column in range(part.projection.components.shape[1])
        ]

    def measured_in(self, analysis: Analysis) -> Float[np.ndarray, "frames D"]:
        """What `measure` gives of the take that the basis was learnt from, out of its analysis."""
        values = {feature.name: feature.values for feature in analysis.features}
        columns = [values[part.name] * part.scale for part in self.parts]
        return np.concatenate(columns, axis=1) if columns else np.zeros((analysis.frames, 0))

    def measure(self, animation: Animation, *, threads: int = 1) -> Float[np.ndarray, "frames D"]:
        """Every frame of a take of this body; raises `InvalidModel` (`wrong-shape`) for another body."""
        if animation.vertex_count != self.vertex_count or not np.array_equal(animation.triangles, self.triangles):
            raise InvalidModel(
                "wrong-shape",
                f"This take has {animation.vertex_count} vertices in {len(animation.triangles)} triangles; the one"
                f" that was fitted has {self.vertex_count} in {len(self.triangles)}, or others. Takes of one body are"
                " compared.",
            )
        animation = animation if self.rest is None else scale_to_rest_size(animation, self.rest)

        def measured(block: Block) -> np.ndarray:
            described = self.body.measure_features(read_vertices(animation, block))
            columns = [part.projection.project(described[part.which]) * part.scale for part in self.parts]
            return np.concatenate(columns, axis=1) if columns else np.zeros((block[1] - block[0], 0))

        blocks = split_into_blocks(animation.frames, frames_per_block(animation.vertex_count))
        with threadpool_limits(1):
            threads = threads_at_once(threads, animation.vertex_count)
            return np.concatenate(list(map_blocks(measured, blocks, threads, total=len(blocks))))
