"""The features of every frame: descriptors on their leading components, learnt from a sample of the take."""

from collections.abc import Sequence

import numpy as np

from caesura.core.analysis import Features
from caesura.core.animation import Animation
from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.block_pass.projection import Projection
from caesura.core.frames.blocks import frames_per_block, map_blocks, split_into_blocks, threads_at_once
from caesura.core.frames.sampled_frames import choose_sample_frames, read_sampled_frames
from caesura.core.progress import Progress, ignore_progress

HELD_BYTES = 64 * 2**20
"""Memory for the whole descriptors of a take; where they do not fit, the sample is drawn beforehand."""

FeatureBasis = tuple[Projection, ...]
"""The components of the patch means of each descriptor, and of the pair distances."""


def learn_feature_basis(
    animation: Animation, body: DescriptorSet, threads: int = 1, progress: Progress = ignore_progress
) -> FeatureBasis | None:
    """Components from at most 2,000 evenly spaced frames; None where the descriptors of all frames can be held."""
    patches = body.patches.patches + sum(other.patches.patches for other in body.others)
    if 4 * animation.frames * (patches + len(body.pairs.first)) <= HELD_BYTES:
        return None
    return learn_from_sample(animation, body, threads, progress)


def learn_from_sample(
    animation: Animation, body: DescriptorSet, threads: int = 1, progress: Progress = ignore_progress
) -> FeatureBasis:
    """Components from at most 2,000 evenly spaced frames."""
    frames = choose_sample_frames(animation.frames)
    blocks = split_into_blocks(len(frames), frames_per_block(animation.vertex_count))

    def described(block: tuple[int, int]) -> tuple[np.ndarray, ...]:
        return body.measure_features(read_sampled_frames(animation, frames[slice(*block)]))

    threads = threads_at_once(threads, animation.vertex_count)
    pages = list(map_blocks(described, blocks, threads, progress=progress, stage="sample", total=len(blocks)))
    return tuple(Projection.of(np.concatenate(kind)) for kind in zip(*pages, strict=True))


def extract_features(
    projections: FeatureBasis | None,
    described: tuple[np.ndarray, ...],
    changing: Sequence[bool],
    names: Sequence[str] = ("strain", "pair-distances"),
    *,
    with_pairs: bool = True,
) -> tuple[Features, ...]:
    """Frames as `described`: already projected where there was a basis, else it is learnt here from the same sample.

    A descriptor that does not change beyond rounding has no columns: its components would be noise. The last are pair
    distances, left out where they were not asked for, unless they alone change.
    """
    if projections is None:
        sample = choose_sample_frames(len(described[0]))
        projections = tuple(Projection.of(values[sample]) for values in described)
        described = tuple(one.project(values) for one, values in zip(projections, described, strict=True))
    found = tuple(
        Features(name, values if changes else values[:, :0].copy(), projection.energy_share)
        for name, projection, values, changes in zip(names, projections, described, changing, strict=True)
    )
    return found if with_pairs or not any(feature.values.shape[1] for feature in found[:-1]) else found[:-1]
