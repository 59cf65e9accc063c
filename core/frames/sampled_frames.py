"""Frames of vertices, drawn and checked: nothing that is not a number goes further."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float32, Int

from caesura.core.animation import Animation, VerticesInRows
from caesura.core.errors import InvalidModel
from caesura.core.frames.blocks import Block
from caesura.core.kernels.descriptors import REACH, largest_bits

SAMPLE = 2000
ROUNDING = 2.0**-20
"""Relative error of an edge whose ends were rounded to float32, with room for how they were made."""


def choose_sample_frames(frames: int, most: int = SAMPLE) -> Int[np.ndarray, "sample"]:
    """At most `most` frames, evenly spaced from the first to the last: they stand for all."""
    if frames <= most:
        return np.arange(frames)
    return np.linspace(0, frames - 1, most).round().astype(np.int64)


def read_vertices(animation: Animation, block: Block) -> Float32[np.ndarray, "frames V 3"]:
    """Frames [start, stop), innermost in memory where they can be drawn so (`rows_of`).

    Raises `InvalidModel` with frame and vertex of a NaN, an infinity or what is above 1e15.
    """
    if isinstance(animation.vertices, VerticesInRows):
        return _read_rows(animation, animation.vertices, np.arange(*block))
    vertices = np.ascontiguousarray(animation.vertices(*block), dtype=np.float32)
    if not largest_coordinate(vertices) <= REACH:  # NaN is not either
        _refuse_not_finite(vertices, range(*block))
    return vertices


def read_sampled_frames(animation: Animation, frames: Int[np.ndarray, "n"]) -> Float32[np.ndarray, "n V 3"]:
    """Some frames, in rising order; as `read_vertices`."""
    if isinstance(animation.vertices, VerticesInRows):
        return _read_rows(animation, animation.vertices, frames)
    return np.concatenate([read_vertices(animation, (frame, frame + 1)) for frame in frames.tolist()])


def _read_rows(
    animation: Animation, source: VerticesInRows, frames: Int[np.ndarray, "n"]
) -> Float32[np.ndarray, "n V 3"]:
    vertices = source.rows(frames).transpose(2, 0, 1)
    if not largest_coordinate(vertices) <= REACH:
        for frame in frames.tolist():  # what draws them may know more of the reason
            animation.vertices(frame, frame + 1)
        _refuse_not_finite(vertices, frames.tolist())
    return vertices


def largest_coordinate(vertices: Float32[np.ndarray, "frames V 3"]) -> float:
    """The largest |coordinate|; NaN where there is one."""
    return float(np.int32(largest_bits(vertices.ravel(order="K").view(np.int32))).view(np.float32))


def _refuse_not_finite(vertices: Float32[np.ndarray, "frames V 3"], frames: Sequence[int]) -> None:
    frame, vertex, _ = np.argwhere(~(np.abs(vertices) <= REACH))[0].tolist()
    value = vertices[frame, vertex][~(np.abs(vertices[frame, vertex]) <= REACH)][0]
    raise InvalidModel(
        "non-finite-data",
        f"At frame {frames[frame]}, vertex {vertex} is at {value}: no place in space. Mend the file and send it again.",
        frame=frames[frame],
        vertex=vertex,
    )
