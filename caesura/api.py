"""The functions for programs: segment or open an animation, arrays, or a file."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.feature_sequence import segment_feature_sequence
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment as segment_animation
from caesura.core.progress import Progress, ignore_progress
from caesura.core.segmentation import Segmentation
from caesura.file_sources import FileSources, is_file_source, open_parts
from caesura.formats.notices import Notices
from caesura.formats.npz.read import check_triangles, vertex_sequence_from_arrays
from caesura.formats.read import read_animation
from caesura.mapped_files import scratch_buffer

READING_PARAMETERS = ("take", "fps", "start", "end", "trim")
"""Parameters that say which frames of a file are read."""


def segment(
    source: Animation | FileSources | ArrayLike,
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
        segment("take.glb", method="joint-entropy", motions=5)

    `source` is one of:

    - vertices (frames, V, 3), real numbers in any one unit of length, with `triangles` (T, 3) of their indices;
      without triangles the vertices are joints of a skeleton. `rest_shape` (V, 3) is the undeformed shape; without it,
      frame 0. `frame_rate` in frames per second, above 0;
    - features (frames, D), whatever was measured of each frame (angles, coordinates, an embedding), not rescaled;
    - a file of any kind that is read: its path (`str` or `Path`), an open file (binary, read from where it stands), or
      its bytes; or several that belong together, such as a .gltf and its .bin: a list of paths, or a mapping by name;
    - an `Animation`, that `open_animation` or a program of yours has made.

    `parameters` are those of `core.Parameters`, of the API and of the command, by the same names: `motions` (a number
    or "auto"), `method`, `fps`, `window_seconds`, … Frames of the result are numbered from 0, intervals half-open.
    The same result for any number of `threads`.

    Raises `CaesuraError`: `ParameterError` for a choice that is not possible, `InputError` for what cannot be cut;
    and OSError for a path that leads nowhere.
    """
    chosen = Parameters.parse(parameters)
    if not (isinstance(source, Animation) or is_file_source(source)):
        source = np.asarray(source)
        if source.ndim == 2:
            return segment_feature_sequence(source, chosen, frame_rate=float(frame_rate))
    animation = open_animation(source, triangles, frame_rate=frame_rate, rest_shape=rest_shape, **parameters)
    return segment_animation(animation, chosen, threads=threads, progress=progress)


def open_animation(
    source: Animation | FileSources | ArrayLike,
    triangles: ArrayLike | None = None,
    *,
    frame_rate: float = 30.0,
    rest_shape: ArrayLike | None = None,
    **parameters: Any,
) -> Animation:
    """The animation that `segment` would cut: its frames, rate, triangles, and `vertices(start, stop)` to draw them.

    Arguments and errors are those of `segment`; of the parameters `take`, `fps`, `start`, `end` and `trim` matter
    here. The animation draws from the file or the buffers that it was given: they must not change while it is used.
    """
    chosen = Parameters.parse(parameters)
    if isinstance(source, Animation):
        _refuse_reading_parameters(parameters)
        return source
    if is_file_source(source):
        return read_animation(open_parts(source), chosen, Limits.none(), scratch_buffer)
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
    faces = _as_triangles(triangles, vertices.shape[1], notices)
    shape = None if rest_shape is None else np.asarray(rest_shape, np.float32)
    if shape is not None and (shape.shape != vertices.shape[1:] or not np.isfinite(shape).all()):
        raise InvalidModel("wrong-shape", f"The rest shape is one finite point for each vertex: {vertices.shape[1:]}.")
    return vertex_sequence_from_arrays(vertices, faces, shape, float(frame_rate), chosen, Limits.none(), notices)


def _as_triangles(given: ArrayLike | None, vertices: int, notices: Notices) -> np.ndarray:
    faces = np.zeros((0, 3), np.int64) if given is None else np.asarray(given)
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iuf":
        raise InvalidModel("wrong-shape", f"Triangles are whole numbers of shape (T, 3); these are {faces.shape}.")
    return check_triangles(faces, vertices, notices)


def _refuse_reading_parameters(parameters: Mapping[str, Any]) -> None:
    for name in READING_PARAMETERS:
        if name in parameters:
            detail = f"{name} says what is read of a file or of arrays; this animation is read already."
            raise ParameterError("invalid-parameter", detail, parameter=name)
