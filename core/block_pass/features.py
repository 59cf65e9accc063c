"""The features of every frame: descriptors on their leading components, learnt from a sample of the take."""

import numpy as np

from caesura.core.analysis import Features
from caesura.core.animation import Animation
from caesura.core.block_pass.measured_body import Body
from caesura.core.block_pass.projection import Projection, sample_frames
from caesura.core.frames.blocks import blocks_of, frames_per_block, map_blocks, threads_at_once
from caesura.core.frames.sampled_frames import draw_frames
from caesura.core.progress import Progress, ignore

HELD_BYTES = 64 * 2**20
"""Memory for the whole descriptors of a take; where they do not fit, the sample is drawn beforehand."""

Basis = tuple[Projection, Projection]
"""The components of the patch means of the descriptor, and of the pair distances."""


def basis(animation: Animation, body: Body, threads: int = 1, progress: Progress = ignore) -> Basis | None:
    """Components from at most 2,000 evenly spaced frames; None where the descriptors of all frames can be held."""
    if 4 * animation.frames * (body.patches.patches + len(body.pairs.first)) <= HELD_BYTES:
        return None
    frames = sample_frames(animation.frames)
    blocks = blocks_of(len(frames), frames_per_block(animation.vertex_count))

    def described(block: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
        return body.describe(draw_frames(animation, frames[slice(*block)]))

    threads = threads_at_once(threads, animation.vertex_count)
    pages = list(map_blocks(described, blocks, threads, progress=progress, stage="sample", total=len(blocks)))
    strain, distances = (np.concatenate(kind) for kind in zip(*pages, strict=True))
    return Projection.of(strain), Projection.of(distances)


def features(
    projections: Basis | None,
    described: tuple[np.ndarray, np.ndarray],
    changing: tuple[bool, bool],
    descriptor: str = "strain",
) -> tuple[Features, Features]:
    """Frames as `described`: already projected where there was a basis, else it is learnt here from the same sample.

    A descriptor that does not change beyond rounding has no columns: its components would be noise.
    """
    if projections is None:
        sample = sample_frames(len(described[0]))
        projections = (Projection.of(described[0][sample]), Projection.of(described[1][sample]))
        described = (projections[0].project(described[0]), projections[1].project(described[1]))
    names = (descriptor, "pair-distances")
    strain, distances = (
        Features(name, values if changes else values[:, :0].copy(), projection.energy_share)
        for name, projection, values, changes in zip(names, projections, described, changing, strict=True)
    )
    return strain, distances
