"""Clips of a point cache: the places of each segment as they are stored, and the OBJ of their faces."""

import struct
from collections.abc import Callable, Iterator
from itertools import chain

from caesura.core.limits import Limits
from caesura.formats.bundle.companion_file import find_companion
from caesura.formats.clips.clip_plan import Clip
from caesura.formats.clips.in_kind.clip_request import ClipRequest
from caesura.formats.point_cache.layout import (
    MDD_HEAD,
    PC2_HEAD,
    POINT_BYTES,
    PointCacheLayout,
    mean_rate,
    rate_of_step,
    read_mdd_layout,
    read_mdd_seconds,
    read_pc2_layout,
)
from caesura.formats.zip.stream_writer import stream_zip

PIECE = 2**24


def write_pc2_clips(request: ClipRequest) -> Iterator[bytes]:
    """The zip of one PC2 for each clip, and their OBJ. Each begins at the frame number at which the take begins."""
    data = request.model.data
    layout = read_pc2_layout(bytes(data[: PC2_HEAD.size]), len(data), Limits.none())
    rate = None if layout.frames_per_sample == 1 else rate_of_step(layout)
    magic, version, points, begin, step, _ = PC2_HEAD.unpack_from(data)

    def head(start: int, stop: int) -> bytes:
        frame = begin + start * step if request.options.origin == "keep" else begin
        return PC2_HEAD.pack(magic, version, points, frame, step, stop - start)

    return _zip(request, layout, rate, head)


def write_mdd_clips(request: ClipRequest) -> Iterator[bytes]:
    """The zip of one MDD for each clip, and their OBJ. Each begins at the second at which the take begins."""
    data = request.model.data
    layout = read_mdd_layout(bytes(data[: MDD_HEAD.size]), len(data), Limits.none())
    seconds = read_mdd_seconds(data, layout)

    def head(start: int, stop: int) -> bytes:
        shift = 0.0 if request.options.origin == "keep" else seconds[start] - seconds[0]
        times = [second - shift for second in seconds[start:stop]]
        return MDD_HEAD.pack(stop - start, layout.points) + struct.pack(f">{len(times)}f", *times)

    return _zip(request, layout, mean_rate(seconds[0], seconds[-1], layout.samples), head)


def _zip(
    request: ClipRequest, layout: PointCacheLayout, rate: float | None, head: Callable[[int, int], bytes]
) -> Iterator[bytes]:
    model, stored, size = request.model, request.stored_frames(layout.samples, rate), layout.points * POINT_BYTES
    mesh = find_companion(model.known, model.name, model.beside)

    def cache(clip: Clip) -> Iterator[bytes]:
        start, stop = stored.of(clip)
        yield head(start, stop)
        for place in range(layout.start + start * size, end := layout.start + stop * size, PIECE):
            yield bytes(model.data[place : min(place + PIECE, end)])

    caches = ((f"{clip.name}.{model.known.name}", cache(clip)) for clip in request.clips)
    return stream_zip(chain(caches, [(mesh.rpartition("/")[2], [bytes(model.beside[mesh])])]), deflated=False)
