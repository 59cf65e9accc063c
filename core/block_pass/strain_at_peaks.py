"""The normalised strain at some frames, for the comparison of key-frames."""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float32, Int

from caesura.core.animation import Animation
from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.frames.blocks import frames_per_block, map_blocks, split_into_blocks, threads_at_once
from caesura.core.frames.sampled_frames import read_sampled_frames
from caesura.core.progress import Progress, ignore_progress

MOST_BYTES = 64 * 2**20


def measure_strain_at_peaks(
    animation: Animation,
    body: DescriptorSet,
    frames: Int[np.ndarray, "peaks"],
    scale: float,
    threads: int = 1,
    progress: Progress = ignore_progress,
    most_bytes: int = MOST_BYTES,
) -> Float32[np.ndarray, "peaks columns"]:
    """Strain over `scale`, clipped at 1, of every column at each frame; patch means where that is over `most_bytes`."""
    whole = 4 * len(frames) * body.surface.columns <= most_bytes or body.patches.patches == 0
    measure = _strain_of_columns if whole else _strain_of_patches
    blocks = split_into_blocks(len(frames), frames_per_block(animation.vertex_count))

    def strain(block: tuple[int, int]) -> np.ndarray:
        return measure(body, read_sampled_frames(animation, frames[slice(*block)]), scale)

    width = body.surface.columns if whole else body.patches.patches
    out = np.empty((len(frames), width), np.float32)
    threads = threads_at_once(threads, animation.vertex_count, body.surface.columns)
    pieces = map_blocks(strain, blocks, threads, progress=progress, stage="key-frames", total=len(blocks))
    for (start, stop), piece in zip(blocks, pieces, strict=True):
        out[start:stop] = piece
    return out


Measure = Callable[[DescriptorSet, np.ndarray, float], np.ndarray]


def _strain_of_columns(body: DescriptorSet, vertices: np.ndarray, scale: float) -> np.ndarray:
    pieces = [np.minimum(tile.T / np.float32(scale), 1) for _, tile in body.surface.tiles(vertices)]
    return np.concatenate(pieces, axis=1)


def _strain_of_patches(body: DescriptorSet, vertices: np.ndarray, scale: float) -> np.ndarray:
    means = body.patches.empty(len(vertices))
    for columns, tile in body.surface.tiles(vertices):
        body.patches.add(columns, np.minimum(tile / np.float32(scale), 1), means)
    return means.T
