"""The binary chunk of a cut file: the bytes that something still refers to, and new arrays behind them."""

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from typing import Any

from caesura.formats.clips.buffer_references import Range, accessor_ranges, views_beside_accessors, whole_view
from caesura.formats.clips.self_contained_gltf import SelfContainedGltf, byte_ranges_of_view
from caesura.formats.gltf.gltf_document import COMPRESSED

PIECE = 2**20

ALIGNED = 8
"""What lies behind bytes that are gone moves by multiples of so many, so that it stays where numbers may be."""

UNUSED_VIEW = {"buffer": 0, "byteLength": 1}
"""What stands in the place of a view that is gone, so that the numbers of the others stay."""


class BinaryChunk:
    """Ranges of what was there, one behind the other, and new arrays, which are kept until they are written."""

    def __init__(self, pieces: list[tuple[int, memoryview]], kept: Iterable[Range]) -> None:
        self._pieces, self._new = pieces, list[tuple[int, bytes]]()
        self._kept = _merge_ranges((start - start % ALIGNED, end) for start, end in kept)
        self._places: list[int] = []
        self.length = 0
        for start, end in self._kept:
            self._places.append(self._take(end - start))

    def append(self, data: bytes) -> int:
        """Add bytes, and say where they are."""
        self._new.append((self._take(len(data)), data))
        return self._new[-1][0]

    def new_offset(self, offset: int) -> int:
        """Where a byte is that was at `offset`."""
        rank = bisect_right(self._kept, (offset, 2**63)) - 1
        return self._places[rank] + offset - self._kept[rank][0]

    def content(self) -> Iterator[bytes]:
        """All of it."""
        at = 0
        for place, data in self._layers():
            yield bytes(place - at)
            for piece in range(0, len(data), PIECE):
                yield bytes(data[piece : piece + PIECE])
            at = place + len(data)

    def _take(self, size: int) -> int:
        start = self.length + -self.length % ALIGNED
        self.length = start + size
        return start

    def _layers(self) -> Iterator[tuple[int, memoryview | bytes]]:
        starts = [start for start, _ in self._pieces]
        for place, (start, end) in zip(self._places, self._kept, strict=True):
            for at, data in self._pieces[max(bisect_right(starts, start) - 1, 0) :]:
                if at >= end:
                    break
                first = max(start - at, 0)
                yield place + at + first - start, data[first : end - at]
        yield from self._new


def drop_unused_bytes(file: SelfContainedGltf, opened: set[int]) -> BinaryChunk:
    """Drop the views that nothing refers to, and of the views `opened` the bytes that no accessor does.

    Views and accessors of the JSON are moved with their bytes; none are where an extension of a view may say where
    it lies.
    """
    root = file.json
    views: list[dict[str, Any]] = root.get("bufferViews", [])
    named = [(part, size) for accessor in root.get("accessors", []) for part, size in accessor_ranges(accessor)]
    others = views_beside_accessors(root)
    apart = {
        n for n in opened - others if not {"extensions", "byteStride"} & views[n].keys() and not views[n]["buffer"]
    }
    inside: dict[int, list[tuple[dict[str, Any], int, int]]] = {}
    for part, size in named:
        if part["bufferView"] in apart:
            begin = views[part["bufferView"]].get("byteOffset", 0) + part.get("byteOffset", 0)
            inside.setdefault(part["bufferView"], []).append((part, begin, begin + size))
    whole = (others | {part["bufferView"] for part, _ in named}) - apart
    kept = [(begin, end) for found in inside.values() for _, begin, end in found]
    kept += [place for number, view in enumerate(views) if number in whole for place in whole_view(view)]
    if any(view.get("extensions", {}).keys() - COMPRESSED for view in views):
        kept.append((0, file.length))
    chunk = BinaryChunk(file.pieces, kept)
    for number, view in enumerate(views):
        if number in inside:
            _shrink(view, inside[number], chunk)
        elif number in whole:
            for part in byte_ranges_of_view(view):
                if part["buffer"] == 0:
                    _put_part(part, chunk.new_offset(part.get("byteOffset", 0)))
        else:
            views[number] = dict(UNUSED_VIEW)
    return chunk


def _shrink(view: dict[str, Any], named: list[tuple[dict[str, Any], int, int]], chunk: BinaryChunk) -> None:
    """Let a view reach from the first byte that an accessor names to the last."""
    first = min(begin for _, begin, _ in named)
    start = chunk.new_offset(first - first % ALIGNED)
    for part, begin, _ in named:
        _put_part(part, chunk.new_offset(begin) - start)
    _put_part(view, start)
    view["byteLength"] = chunk.new_offset(max(end for _, _, end in named) - 1) + 1 - start


def _put_part(part: dict[str, Any], offset: int) -> None:
    part["byteOffset"] = offset
    if not offset:
        del part["byteOffset"]


def _merge_ranges(ranges: Iterable[Range]) -> list[Range]:
    """The same bytes as few ranges, in order and apart."""
    joined: list[Range] = []
    for start, end in sorted(ranges):
        if joined and start <= joined[-1][1]:
            joined[-1] = (joined[-1][0], max(joined[-1][1], end))
        elif end > start:
            joined.append((start, end))
    return joined
