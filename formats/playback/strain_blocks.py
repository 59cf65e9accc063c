"""Strain for the eye: one byte for every patch of the surface and frame, 0 at rest, 255 at the strain that counts as 1.

Where another descriptor was chosen, it is that one that is shown.

More patches than the features use, for these are looked at; fewer the longer the take is, so that the file stays
below 64 MB.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Int, UInt8

from caesura.core.animation import Animation
from caesura.core.descriptors.descriptor import Descriptor
from caesura.core.descriptors.patch_means import PatchMeans
from caesura.core.descriptors.strain import TriangleStrain
from caesura.core.frames.blocks import Block, frames_per_block, map_blocks, split_into_blocks
from caesura.core.mesh.patches import assign_patches
from caesura.core.progress import Progress, ignore_progress
from caesura.core.single_threaded_blas import single_threaded_blas
from caesura.formats.playback.block_file import FRAMES_PER_BLOCK, write_block_file

MOST_PATCHES = 512
FEWEST_PATCHES = 64
FILE_BYTES = 64 * 2**20


@dataclass(frozen=True)
class DisplayPatches:
    """The patches of a body, and the patch of each of its vertices (of one of the triangles around it)."""

    surface: Descriptor
    means: PatchMeans
    of_vertex: Int[np.ndarray, "V"]


def choose_display_patches(
    rest: Float32[np.ndarray, "V 3"],
    triangles: Int[np.ndarray, "T 3"],
    frames: int,
    measure: str,
    descriptor: Callable[[TriangleStrain], Descriptor] = lambda strain: strain,
) -> DisplayPatches:
    """The patches to show, of strain or of another `descriptor` of the same triangles.

    A patch none of whose triangles can be strained is joined to its neighbour in number.
    """
    count = min(max(FILE_BYTES // frames, FEWEST_PATCHES), MOST_PATCHES)
    patch = assign_patches(rest, triangles, count)
    strain = TriangleStrain.of(rest, triangles, np.argsort(patch, kind="stable"), measure)
    met = np.unique(patch[strain.triangles])
    patch = np.searchsorted(met, patch).clip(max=max(len(met) - 1, 0))
    of_vertex = np.zeros(len(rest), np.int64)
    of_vertex[triangles] = patch[:, None]
    return DisplayPatches(descriptor(strain), PatchMeans.of(patch[strain.triangles], strain.areas), of_vertex)


def write_strain_blocks(
    animation: Animation, shown: DisplayPatches, scale: float, *, threads: int = 1, progress: Progress = ignore_progress
) -> Iterator[bytes]:
    """The block file: `patches` bytes a frame. `scale` is the strain that counts as 1. Stage "figure"."""
    blocks = split_into_blocks(animation.frames, FRAMES_PER_BLOCK)

    def measured(block: Block) -> UInt8[np.ndarray, "block patches"]:
        start, stop = block
        return np.concatenate(
            [
                _bytes(animation, shown, scale, start + first, start + last)
                for first, last in split_into_blocks(stop - start, frames_per_block(animation.vertex_count))
            ]
        )

    found = map_blocks(measured, blocks, threads, progress=progress, stage="figure", total=len(blocks))
    facts = {"kind": "strain", "patches": shown.means.patches, "strain_scale": scale}
    with single_threaded_blas():  # a heat kernel is algebra, whose own threads would wait for ours
        yield from write_block_file(facts, {}, animation.frames, shown.means.patches, found)


def _bytes(
    animation: Animation, shown: DisplayPatches, scale: float, start: int, stop: int
) -> UInt8[np.ndarray, "block patches"]:
    means = shown.means.empty(stop - start)
    vertices = np.ascontiguousarray(animation.vertices(start, stop), np.float32)
    for columns, tile in shown.surface.tiles(vertices):
        shown.means.add(columns, tile, means)
    return np.rint(means.T * np.float32(255 / scale)).clip(0, 255).astype(np.uint8)
