"""A vertex sequence as the page plays it: int16 positions in the cube the take moves in, 32 frames a block.

A coordinate q stands for `centre` + `half` · q / 32767: one scale on all axes, so that the page may light the
surface without undoing a stretch. The error is at most half / 65534 on an axis, a sixth of a millimetre for a
character that walks over twenty metres.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float, Float32, Int, Int16

from caesura.core.animation import Animation
from caesura.core.frames.blocks import Block, frames_per_block, map_blocks, split_into_blocks
from caesura.core.progress import Progress, ignore_progress
from caesura.formats.playback.block_file import FRAMES_PER_BLOCK, write_block_file
from caesura.formats.playback.decimation import DecimatedMesh, decimate_mesh

POSES = 4  # poses a decimation is judged in
LARGEST = 32767


def choose_display_mesh(animation: Animation) -> DecimatedMesh:
    """What is drawn of the mesh: all of it up to 30,000 triangles."""
    frames = np.linspace(0, animation.frames - 1, POSES).astype(int).tolist()
    return decimate_mesh(np.concatenate([animation.vertices(f, f + 1) for f in frames]), animation.triangles)


def write_vertex_blocks(
    animation: Animation,
    mesh: DecimatedMesh,
    patch_of_vertex: Int[np.ndarray, "V"],
    *,
    threads: int = 1,
    progress: Progress = ignore_progress,
) -> Iterator[bytes]:
    """The block file: facts, `triangles`, `patches` and `source_vertices` (of the file), then positions (kept, 3).

    The vertices are drawn twice, once for the cube. `progress` hears the stage "figure".
    """
    centre, half = _cube(animation, mesh, threads, lambda stage, share: progress(stage, share / 2))
    facts = {
        "kind": "vertices",
        "vertices": len(mesh.vertices),
        "centre": centre.tolist(),
        "half": half,
        "of": {"vertices": animation.vertex_count, "triangles": len(animation.triangles)},
    }
    arrays = {
        "triangles": mesh.triangles.astype("<u4"),
        "patches": patch_of_vertex[mesh.vertices].astype("<u2"),
        "source_vertices": mesh.vertices.astype("<u4"),
    }
    blocks = split_into_blocks(animation.frames, FRAMES_PER_BLOCK)
    quantized = map_blocks(
        lambda block: _quantized(animation, mesh, block, centre, np.float32(LARGEST / half)),
        blocks,
        threads,
        progress=lambda stage, share: progress(stage, (1 + share) / 2),
        stage="figure",
        total=len(blocks),
    )
    yield from write_block_file(facts, arrays, animation.frames, len(mesh.vertices) * 3 * 2, quantized)


def _cube(
    animation: Animation, mesh: DecimatedMesh, threads: int, progress: Progress
) -> tuple[Float32[np.ndarray, "3"], float]:
    """Centre and half the edge of the smallest cube on the axes that holds every frame."""
    blocks = split_into_blocks(animation.frames, FRAMES_PER_BLOCK)
    low, high = np.full(3, np.inf, np.float32), np.full(3, -np.inf, np.float32)
    for lowest, highest in map_blocks(
        lambda block: _extent(animation, mesh, block),
        blocks,
        threads,
        progress=progress,
        stage="figure",
        total=len(blocks),
    ):
        low, high = np.minimum(low, lowest), np.maximum(high, highest)
    return (low + high) / 2, float((high - low).max() / 2) or 1.0


def _drawn(
    animation: Animation, mesh: DecimatedMesh, block: Block
) -> Iterator[tuple[int, Float32[np.ndarray, "n kept 3"]]]:
    """The kept vertices of a block, in pieces small enough for the largest mesh; with the frame each starts at."""
    start, stop = block
    for first, last in split_into_blocks(stop - start, frames_per_block(animation.vertex_count)):
        yield first, animation.vertices(start + first, start + last)[:, mesh.vertices]


def _extent(
    animation: Animation, mesh: DecimatedMesh, block: Block
) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3"]]:
    ends = [(piece.min(axis=(0, 1)), piece.max(axis=(0, 1))) for _, piece in _drawn(animation, mesh, block)]
    return np.min([low for low, _ in ends], axis=0), np.max([high for _, high in ends], axis=0)


def _quantized(
    animation: Animation, mesh: DecimatedMesh, block: Block, centre: Float32[np.ndarray, "3"], scale: np.float32
) -> Int16[np.ndarray, "block kept 3"]:
    start, stop = block
    out = np.empty((stop - start, len(mesh.vertices), 3), "<i2")
    for first, piece in _drawn(animation, mesh, block):
        out[first : first + len(piece)] = np.rint((piece - centre) * scale).clip(-LARGEST, LARGEST)
    return out
