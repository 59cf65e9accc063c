"""Where the arrays of the clips go: into room that the take has left, and compressed where the file is."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from core.formats.clips.binary_chunk import BinaryChunk
from core.formats.clips.free_space import free_ranges, joined, unused_views, whole_view
from core.formats.clips.packing import Compression, Strip, compression_of
from core.formats.clips.self_contained import SelfContained, addressed
from core.formats.clips.streams import WORTH, shortened
from core.formats.gltf.accessors import Accessors
from core.formats.gltf.document import COMPRESSED

UNUSED = {"componentType": 5126, "count": 1, "type": "SCALAR"}
"""What stands in the place of an accessor that is gone, so that the numbers of the others stay."""

Packed = tuple[Strip, bytes]
"""Arrays one after the other, and what they are compressed."""


@dataclass(frozen=True)
class NewAccessor:
    """Its number and its JSON; `data` in rows of so many bytes, one a key, or None where it is a window."""

    number: int
    json: dict[str, Any]
    data: bytes | None
    row: int


def placed(file: SelfContained, accessors: Accessors, freed: Sequence[int], new: Sequence[NewAccessor]) -> BinaryChunk:
    """Write new accessors and their views into the JSON, and their bytes into what is returned.

    Accessors `freed` are gone, and so are the bytes that none but them named.
    """
    root = file.json
    windows = [accessor.json for accessor in new if accessor.data is None]
    streams = shortened(root, accessors, freed, windows)
    left = [(stream.start + len(stream.data), stream.end) for stream in streams]
    chunk = BinaryChunk(file.pieces, file.length, joined([*free_ranges(root, freed, windows), *left]))
    spare = sorted([*unused_views(root, freed, windows), *(stream.view for stream in streams if not stream.data)])
    views = root.setdefault("bufferViews", [])
    for stream in streams:
        stream.extension["byteLength"] = len(stream.data)
        chunk.patch(stream.start, stream.data)
    for number in freed:
        root["accessors"][number] = dict(UNUSED)
    for number in spare:
        views[number] = {"buffer": 0, "byteLength": 1}
    for accessor in new:
        root["accessors"][accessor.number] = accessor.json
    _put(root, chunk, spare, (accessor for accessor in new if accessor.data is not None))
    for view in views:  # of a take that lay last only parts may have stayed
        if view["buffer"] == 0:
            view["byteLength"] = min(view["byteLength"], chunk.end - view.get("byteOffset", 0))
    _squeeze(chunk, [view for number, view in enumerate(views) if number not in spare])
    return chunk


def _squeeze(chunk: BinaryChunk, views: Iterable[dict[str, Any]]) -> None:
    """Cut out what room is left, and move the views behind it; not where an extension may say what lies there."""
    views = list(views)
    if any(view.get("extensions", {}).keys() - COMPRESSED for view in views):
        return
    chunk.squeeze(joined(part for view in views for part in whole_view(view)))
    for part in (part for view in views for part in addressed(view)):
        if part["buffer"] == 0 and "byteOffset" in part:
            part["byteOffset"] = chunk.moved(part["byteOffset"])


class _Views:
    """The views of the file, and numbers of those that nobody names any more."""

    def __init__(self, views: list[dict[str, Any]], spare: list[int]) -> None:
        self._views, self._spare = views, spare

    def add(self, view: dict[str, Any]) -> int:
        """The number of a new view."""
        number = self._spare.pop() if self._spare else len(self._views)
        self._views[number : number + 1] = [view]
        return number


def _put(root: dict[str, Any], chunk: BinaryChunk, spare: list[int], arrays: Iterable[NewAccessor]) -> None:
    """Arrays whose keys are of one size together, for they are alike; those with the largest keys first."""
    views, compression = _Views(root["bufferViews"], spare), compression_of(root)
    for _, alike in groupby(sorted(arrays, key=lambda a: -a.row), key=lambda a: a.row):
        plain = list(alike)
        if compression:
            plain = _put_compressed(chunk, views, compression, plain)
        for accessor in plain:
            _name(accessor, *_in_room(chunk, views, accessor))


def _put_compressed(
    chunk: BinaryChunk, views: _Views, compression: Compression, arrays: list[NewAccessor]
) -> list[NewAccessor]:
    """Arrays as one view, or as several where there is room for a part of them; back come those not worth it."""
    while (whole := _packed(arrays)) is not None:
        strip, stream = _fitting(chunk.roomiest, arrays, whole)
        room, offset = chunk.put(stream, len(stream))
        number = views.add(compression.view(strip, room.start + offset, len(stream)))
        for accessor, start in zip(arrays, strip.offsets, strict=False):  # the strip may be of the first of them
            _name(accessor, number, start)
        arrays = arrays[len(strip.offsets) :]
    return arrays


def _fitting(room: int, arrays: list[NewAccessor], whole: Packed) -> Packed:
    """The first of the arrays, as many as fit into so many bytes; all where so few would not be worth it."""
    part = whole
    while WORTH < room < len(part[1]):
        strip, stream = part
        fewer = _packed(arrays[: int(0.95 * len(strip.offsets) * room / len(stream))])
        if fewer is None:
            return whole
        part = fewer
    return part


def _packed(arrays: list[NewAccessor]) -> Packed | None:
    """The arrays as a strip, and its stream; None where there are none, or it is not worth it."""
    if not arrays:
        return None
    strip = Strip([accessor.data or b"" for accessor in arrays], arrays[0].row)
    stream = strip.packed()
    return None if stream is None else (strip, stream)


def _in_room(chunk: BinaryChunk, views: _Views, accessor: NewAccessor) -> tuple[int, int]:
    """Where an array is that is not compressed: the view and where in it."""
    data = accessor.data or b""
    room, offset = chunk.put(data, accessor.row)
    if room.view is None:
        room.view = {"buffer": 0, "byteOffset": room.start}
        room.number = views.add(room.view)
    room.view["byteLength"] = offset + len(data)
    return room.number, offset


def _name(accessor: NewAccessor, view: int, offset: int) -> None:
    accessor.json.update({"bufferView": view, **({"byteOffset": offset} if offset else {})})
