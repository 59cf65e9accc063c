"""Clips of a BVH: the same skeleton, and of its frames those of a segment, word for word."""

import re
from collections.abc import Iterator

from caesura.core.limits import Limits
from caesura.formats.bvh.gltf_conversion import read_motion_values
from caesura.formats.bvh.hierarchy import MOTION, BvhHeader, read_bvh_header
from caesura.formats.clips.in_kind.clip_request import ClipRequest
from caesura.formats.zip.stream_writer import stream_zip

FRAMES = re.compile(rb"(Frames:[ \t]*)\S+")
AT_ONCE = 1000


def write_bvh_clips(request: ClipRequest) -> Iterator[bytes]:
    """The zip of one BVH for each clip, frames [start, end)."""
    data = request.model.data
    head = read_bvh_header(bytes(data[: 2**23]), Limits.none())
    lines = _frame_lines(data, head)
    text = bytes(data[: head.start])
    motion = text.rindex(MOTION)
    stored = request.stored_frames(head.frames, head.rate)

    def clip_text(start: int, stop: int) -> Iterator[bytes]:
        yield text[:motion] + FRAMES.sub(rb"\g<1>%d" % (stop - start), text[motion:])
        for first in range(start, stop, AT_ONCE):
            yield b"\n".join(lines[first : min(first + AT_ONCE, stop)]) + b"\n"

    files = ((f"{clip.name}.bvh", clip_text(*stored.of(clip))) for clip in request.clips)
    return stream_zip(files, deflated=True)


def _frame_lines(data: memoryview, head: BvhHeader) -> list[bytes]:
    """The line of each frame; of a file that has not one for each, new ones of the same numbers."""
    lines = [line for line in bytes(data[head.start :]).splitlines() if line and not line.isspace()]
    if all(len(line.split()) == head.columns for line in lines[: head.frames]):
        return lines[: head.frames]
    return [" ".join(map(repr, row)).encode() for row in read_motion_values(data, head).tolist()]
