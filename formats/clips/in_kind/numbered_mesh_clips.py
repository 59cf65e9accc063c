"""Clips of numbered OBJ or PLY files: a folder of them for each clip, each file as it was sent."""

from collections.abc import Iterator
from typing import BinaryIO, cast

from caesura.core.limits import Limits
from caesura.formats.bundle.read import read_member
from caesura.formats.bundle.zip_members import ZipMembers
from caesura.formats.clips.in_kind.clip_request import ClipRequest
from caesura.formats.zip.buffer_file import BufferFile
from caesura.formats.zip.stream_writer import stream_zip


def write_shape_clips(request: ClipRequest) -> Iterator[bytes]:
    """The zip, with a folder for each clip."""
    data = request.model.data
    files = ZipMembers(cast("BinaryIO", BufferFile(data)), Limits.none())
    names = files.shapes()
    stored = request.stored_frames(len(names), None)

    def content(name: str) -> Iterator[bytes]:
        yield bytes(read_member(files, name, data, lambda size: memoryview(bytearray(size))))

    alone = [name.rpartition("/")[2] for name in names]
    called = dict(zip(names, alone if len(set(alone)) == len(alone) else names, strict=True))
    members = (
        (f"{clip.name}/{called[name]}", content(name))
        for clip in request.clips
        for name in names[slice(*stored.of(clip))]
    )
    return stream_zip(members, deflated=True)
