"""The door for programs: an animation, arrays, or the bytes of a file, as Python has them at hand."""

from collections.abc import Mapping
from mmap import mmap
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.feature_sequence import segment_features
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment as segment_animation
from caesura.core.progress import Progress, ignore_progress
from caesura.core.segmentation import Segmentation
from caesura.formats.notices import Notices
from caesura.formats.npz.read import check_triangles, vertex_sequence_from_arrays
from caesura.formats.read import read_animation

Bytes = bytes | bytearray | memoryview | mmap
READING = ("take", "fps", "start", "end", "trim")
"""Parameters that say which frames of a file are read."""


def segment(
    source: Animation | Bytes | Mapping[str, Bytes] | ArrayLike,
    triangles: ArrayLike | None = None,
    *,
    frame_rate: float = 30.0,
    rest_shape: ArrayLike | None = None,
    threads: int = 1,
    progress: Progress = ignore_progress,
    **parameters: Any,
) -> Segmentation:
    """The motions of a take: which there are, where each begins and ends, and how sure each cut is.

        segment(vertices, triangles, frame_rate=30, motions=5)
        segment(Path("take.glb").read_bytes(), method="joint-entropy", motions=5)

    `source` is one of:
    - vertices (frames, V, 3), real numbers in any one unit of length, with `triangles` (T, 3) of their indices;
      without triangles the vertices are joints of a skeleton. `rest_shape` (V, 3) is the undeformed shape; without it,
      frame 0. `frame_rate` in frames per second, above 0;
    - features (frames, D), whatever was measured of each frame (angles, coordinates, an embedding), not rescaled;
    - the bytes of a file (GLB, glTF, BVH, NPZ, zip), or several by name, such as a .gltf and its .bin;
    - an `Animation`, that `open_animation` or a program of yours has made.

    `parameters` are those of `core.Parameters`, of the API and of the command, by the same names: `motions` (a number
    or "auto"), `method`, `fps`, `window_seconds`, … Frames of the result are numbered from 0, intervals half-open.
    The same result for any number of `threads`.

    Raises `CaesuraError`: `ParameterError` for a choice that is not possible, `InputError` for what cannot be cut.
    """
    chosen = Parameters.parse(parameters)
    if not isinstance(source, Animation | bytes | bytearray | memoryview | mmap | Mapping):
        source = np.asarray(source)
        if source.ndim == 2:
            return segment_features(source, chosen, frame_rate=frame_rate)
    animation = open_animation(source, triangles, frame_rate=frame_rate, rest_shape=rest_shape, **parameters)
    return segment_animation(animation, chosen, threads=threads, progress=progress)


def open_animation(
    source: Animation | Bytes | Mapping[str, Bytes] | ArrayLike,
    triangles: ArrayLike | None = None,
    *,
    frame_rate: float = 30.0,
    rest_shape: ArrayLike | None = None,
    **parameters: Any,
) -> Animation:
    """The animation that `segment` would cut: its frames, rate, triangles, and `vertices(start, stop)` to draw them.

    Arguments and errors are those of `segment`; of the parameters `take`, `fps`, `start`, `end` and `trim` matter
    here. Buffers must outlive the animation, which draws from them.
    """
    chosen = Parameters.parse(parameters)
    if isinstance(source, Animation):
        _refuse_reading(parameters)
        return source
    if isinstance(source, bytes | bytearray | memoryview | mmap):
        source = {"": source}
    if isinstance(source, Mapping):
        parts = {name: memoryview(part) for name, part in source.items()}
        return read_animation(parts, chosen, Limits.none(), lambda size: memoryview(bytearray(size)))
    return _of_arrays(np.asarray(source), triangles, rest_shape, frame_rate, chosen)


def _of_arrays(
    vertices: np.ndarray,
    triangles: ArrayLike | None,
    rest_shape: ArrayLike | None,
    frame_rate: float,
    chosen: Parameters,
) -> Animation:
    if vertices.ndim != 3 or vertices.shape[2] != 3 or 0 in vertices.shape or vertices.dtype.kind not in "fiu":
        raise InvalidModel(
            "wrong-shape",
            f"Vertices are numbers of shape (frames, V, 3), features (frames, D); this is {vertices.dtype} of shape"
            f" {vertices.shape}.",
        )
    if not (np.isfinite(frame_rate) and frame_rate > 0):
        raise ParameterError("invalid-frame-rate", f"The frame rate is {frame_rate:g}; frames per second are expected.")
    notices = Notices()
    faces = _triangles(triangles, vertices.shape[1], notices)
    shape = None if rest_shape is None else np.asarray(rest_shape, np.float32)
    if shape is not None and (shape.shape != vertices.shape[1:] or not np.isfinite(shape).all()):
        raise InvalidModel("wrong-shape", f"The rest shape is one finite point for each vertex: {vertices.shape[1:]}.")
    return vertex_sequence_from_arrays(vertices, faces, shape, float(frame_rate), chosen, Limits.none(), notices)


def _triangles(given: ArrayLike | None, vertices: int, notices: Notices) -> np.ndarray:
    faces = np.zeros((0, 3), np.int64) if given is None else np.asarray(given)
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iuf":
        raise InvalidModel("wrong-shape", f"Triangles are whole numbers of shape (T, 3); these are {faces.shape}.")
    return check_triangles(faces, vertices, notices)


def _refuse_reading(parameters: Mapping[str, Any]) -> None:
    for name in READING:
        if name in parameters:
            detail = f"{name} says what is read of a file or of arrays; this animation is read already."
            raise ParameterError("invalid-parameter", detail, parameter=name)
