"""The features of every frame: descriptors on their leading components, learnt from a sample of the take."""

import numpy as np

from caesura.core.analysis import Features
from caesura.core.animation import Animation
from caesura.core.block_pass.measured_body import MeasuredBody
from caesura.core.block_pass.projection import Projection, choose_sample_frames
from caesura.core.frames.blocks import frames_per_block, map_blocks, split_into_blocks, threads_at_once
from caesura.core.frames.sampled_frames import read_sampled_frames
from caesura.core.progress import Progress, ignore_progress

HELD_BYTES = 64 * 2**20
"""Memory for the whole descriptors of a take; where they do not fit, the sample is drawn beforehand."""

FeatureBasis = tuple[Projection, Projection]
"""The components of the patch means of the descriptor, and of the pair distances."""


def learn_feature_basis(
    animation: Animation, body: MeasuredBody, threads: int = 1, progress: Progress = ignore_progress
) -> FeatureBasis | None:
    """Components from at most 2,000 evenly spaced frames; None where the descriptors of all frames can be held."""
    if 4 * animation.frames * (body.patches.patches + len(body.pairs.first)) <= HELD_BYTES:
        return None
    frames = choose_sample_frames(animation.frames)
    blocks = split_into_blocks(len(frames), frames_per_block(animation.vertex_count))

    def described(block: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
        return body.describe(read_sampled_frames(animation, frames[slice(*block)]))

    threads = threads_at_once(threads, animation.vertex_count)
    pages = list(map_blocks(described, blocks, threads, progress=progress, stage="sample", total=len(blocks)))
    strain, distances = (np.concatenate(kind) for kind in zip(*pages, strict=True))
    return Projection.of(strain), Projection.of(distances)


def extract_features(
    projections: FeatureBasis | None,
    described: tuple[np.ndarray, np.ndarray],
    changing: tuple[bool, bool],
    descriptor: str = "strain",
) -> tuple[Features, Features]:
    """Frames as `described`: already projected where there was a basis, else it is learnt here from the same sample.

    A descriptor that does not change beyond rounding has no columns: its components would be noise.
    """
    if projections is None:
        sample = choose_sample_frames(len(described[0]))
        projections = (Projection.of(described[0][sample]), Projection.of(described[1][sample]))
        described = (projections[0].project(described[0]), projections[1].project(described[1]))
    names = (descriptor, "pair-distances")
    strain, distances = (
        Features(name, values if changes else values[:, :0].copy(), projection.energy_share)
        for name, projection, values, changes in zip(names, projections, described, changing, strict=True)
    )
    return strain, distances
