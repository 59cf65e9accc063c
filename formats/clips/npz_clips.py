"""Clips of an NPZ: a zip of one for each, in the form that it was sent in."""

import io
from collections.abc import Iterator
from typing import BinaryIO, cast

import numpy as np
from jaxtyping import Shaped

from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.formats.clips.clip_plan import Clip
from caesura.formats.clips.in_kind.clip_request import ClipRequest
from caesura.formats.clips.in_kind.pose_clips import write_pose_clips
from caesura.formats.npz.array_roles import find_body_poses
from caesura.formats.npz.read import read_npz
from caesura.formats.vertex_sequence import VertexSequence
from caesura.formats.zip.archive import ZipArchive
from caesura.formats.zip.buffer_file import BufferFile
from caesura.formats.zip.stream_writer import stream_zip

BLOCK_BYTES = 2**24


def write_npz_clips(request: ClipRequest) -> Iterator[bytes]:
    """The zip. Frames are those of the segments, half-open, so the clips one after the other are the take again."""
    archive = ZipArchive(cast("BinaryIO", BufferFile(request.model.data)), Limits.none())
    if poses := find_body_poses(archive):
        return write_pose_clips(request, archive, poses)
    animation, clips = read_npz(request.model.data, request.parameters, Limits.none(), request.scratch), request.clips
    return stream_zip(((f"{clip.name}.npz", _npz(animation, clip)) for clip in clips), deflated=False)


def _npz(animation: Animation, clip: Clip) -> Iterator[bytes]:
    """`vertices`, `triangles`, `frame_rate` and, where the file has one, `rest`; and `start_seconds` in the take."""
    arrays = {"triangles": animation.triangles, "frame_rate": np.float64(animation.frame_rate)}
    if animation.rest is not None:
        arrays["rest"] = animation.rest
    arrays["start_seconds"] = np.float64(clip.extras["start_seconds"])
    members = ((f"{name}.npy", _npy(np.asarray(array))) for name, array in arrays.items())
    return stream_zip([("vertices.npy", _frames(animation, clip)), *members], deflated=False)


def _frames(animation: Animation, clip: Clip) -> Iterator[bytes]:
    """The clip's frames, handles included, as the numbers they were stored as where frames are drawn as stored."""
    handle = round(clip.extras.get("handles_seconds", 0.0) * animation.frame_rate)
    start, stop = max(clip.start_frame - handle, 0), min(clip.end_frame + handle, animation.frames)
    draw = animation.vertices
    plain = isinstance(draw, VertexSequence) and draw.step == 1 and draw.first.is_integer()
    stored = draw.stored[int(draw.first) :] if isinstance(draw, VertexSequence) and plain else None
    dtype = np.dtype(np.float32) if stored is None else stored.dtype
    yield _header(dtype, (stop - start, animation.vertex_count, 3))
    step = max(BLOCK_BYTES // (animation.vertex_count * 3 * dtype.itemsize), 1)
    for first in range(start, stop, step):
        last = min(first + step, stop)
        block = draw(first, last) if stored is None else stored[first:last]
        yield np.ascontiguousarray(block).tobytes()


def _npy(array: Shaped[np.ndarray, "..."]) -> Iterator[bytes]:
    yield _header(array.dtype, array.shape)
    yield np.ascontiguousarray(array).tobytes()


def _header(dtype: np.dtype[np.generic], shape: tuple[int, ...]) -> bytes:
    out = io.BytesIO()
    described = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(out, described)
    return out.getvalue()
