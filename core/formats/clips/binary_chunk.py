"""The binary chunk of the file as it was, with new arrays in the room that was freed, and behind it."""

from bisect import bisect_left
from collections.abc import Iterator
from itertools import accumulate, chain
from typing import Any

from core.formats.clips.free_space import Range, without

PIECE = 2**20

HOLE = 64
"""Bytes that must be unused on end to be cut out."""

ALIGNED = 8
"""What lies behind a hole moves by multiples of so many bytes, so that it stays where numbers may be."""


class BinaryChunk:
    """`pieces` lie at their offsets, `free` is room between them. Arrays are kept until they are written."""

    def __init__(self, pieces: list[tuple[int, memoryview]], length: int, free: list[Range]) -> None:
        self._old = pieces
        self._patches: list[tuple[int, bytes]] = []
        self._rooms = [Room(-(-start // 4) * 4, end) for start, end in free]
        if free and length - free[-1][1] < 4:
            self._rooms.pop()
            length = free[-1][0]
            self._old = [(at, data[: max(length - at, 0)]) for at, data in pieces]
        self._patches += [(start, bytes(end - start)) for start, end in free if end <= length]
        self._tail = Room(-(-length // 4) * 4, 2**63)
        self._holes: list[Range] = []
        self._gone = [0]
        self.end = length

    def put(self, data: bytes, row: int) -> tuple["Room", int]:
        """Find room for an array of rows of so many bytes: the room, whose view it will be in, and where in it."""
        room = next((r for r in self._rooms if r.end - r.after(data, row) >= len(data)), self._tail)
        at = room.take(data, row)
        self._patches.append((at, data))
        if room is self._tail:
            self.end = at + len(data)
        return room, at - room.start

    def patch(self, start: int, data: bytes) -> None:
        """Put other bytes over some that are there."""
        self._patches.append((start, data))

    @property
    def roomiest(self) -> int:
        """Bytes of the largest room between what stays."""
        return max((room.end - room.next for room in self._rooms), default=0)

    def squeeze(self, used: list[Range]) -> None:
        """Cut out room that is left and has none of the `used` bytes, which are in order and apart.

        From then on `moved` says where bytes are.
        """
        for first, last in without(((room.next, room.end) for room in self._rooms), used):
            start, end = -(-first // ALIGNED) * ALIGNED, last // ALIGNED * ALIGNED
            if end - start >= HOLE:
                self._holes.append((start, end))
        self._gone = [0, *accumulate(end - start for start, end in self._holes)]

    def moved(self, offset: int) -> int:
        """Where a byte is that was at `offset`."""
        return offset - self._gone[bisect_left(self._holes, (offset, 0))]

    @property
    def length(self) -> int:
        """Bytes, without padding."""
        return self.moved(self.end)

    def content(self) -> Iterator[bytes]:
        """All of it: what was there, patched, and what is new."""
        at = 0
        for start, data in self._layers():
            yield bytes(self.moved(start) - at)
            for piece in range(0, len(data), PIECE):
                yield bytes(data[piece : piece + PIECE])
            at = self.moved(start) + len(data)
        yield bytes(self.length - at)

    def _layers(self) -> Iterator[tuple[int, memoryview]]:
        """Stretches in order that do not overlap: a patch hides what is under it, a later patch an earlier one."""
        layers = [*self._old, *((start, memoryview(data)) for start, data in self._patches)]
        edges = sorted({*(edge for start, data in layers for edge in (start, start + len(data))), *chain(*self._holes)})
        top: dict[int, int] = {}
        place = {edge: number for number, edge in enumerate(edges)}
        for number, (start, data) in enumerate(layers):
            for edge in range(place[start], place[start + len(data)]):
                top[edge] = number
        for start, end in self._holes:
            for edge in range(place[start], place[end]):
                top.pop(edge, None)
        for edge in sorted(top):
            start, data = layers[top[edge]]
            yield edges[edge], data[edges[edge] - start : edges[edge + 1] - start]


class Room:
    """Bytes [start, end), of which those before `next` are taken."""

    def __init__(self, start: int, end: int) -> None:
        self.start = self.next = start
        self.end = end
        self.view: dict[str, Any] | None = None
        self.number = -1
        self._last = b""

    def take(self, data: bytes, row: int) -> int:
        """Where the array goes."""
        at = self.after(data, row)
        self.next, self._last = at + -(-len(data) // 4) * 4, data
        return at

    def after(self, data: bytes, row: int) -> int:
        """Where it would go: on the last row of the one before where it begins with that, as one clip does where
        another ends."""
        shares = not (row % 4 or len(self._last) % 4) and row < len(data) and self._last.endswith(data[:row])
        return self.next - row if shares else self.next
