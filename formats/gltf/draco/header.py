"""What a Draco stream promises before it is decoded (Draco bitstream specification 2.2, sections 2 to 4)."""

import struct

MAGIC = b"DRACO"
MESH = 1
SEQUENTIAL, EDGEBREAKER = 0, 1
WITH_METADATA = 0x8000
VERSION = (2, 2)
"""The only one that glTF allows."""


def read_draco_counts(data: memoryview) -> tuple[int, int]:
    """At most how many vertices the connectivity has, and how many faces; `ValueError` where that cannot be read.

    A few bytes of a stream may promise a billion of each: the decoder would allocate them.
    """
    if data[:5] != MAGIC or len(data) < 11:
        raise ValueError("it is no Draco stream")
    major, minor, kind, method, flags = struct.unpack_from("<BBBBH", data, 5)
    if kind != MESH or method not in (SEQUENTIAL, EDGEBREAKER) or (major, minor) != VERSION:
        raise ValueError("it is no mesh of Draco 2.2")
    numbers = _ByteReader(data, 11)
    if flags & WITH_METADATA:
        numbers.skip_metadata()
    if method == SEQUENTIAL:
        faces, vertices = numbers.next(), numbers.next()
    else:
        numbers.skip(1)  # how the mesh is walked
        vertices, faces = numbers.next(), numbers.next()
    return vertices, faces


class _ByteReader:
    """Reads one number after the other."""

    def __init__(self, data: memoryview, at: int) -> None:
        self._data = data
        self._at = at

    def next(self) -> int:
        """The next number, as short as it can be (LEB128)."""
        value = 0
        for shift in range(0, 70, 7):
            byte = self.byte()
            value |= (byte & 127) << shift
            if byte < 128:
                return value
        raise ValueError("a number in it has no end")

    def byte(self) -> int:
        """The next byte."""
        self.skip(1)
        return self._data[self._at - 1]

    def skip(self, count: int) -> None:
        """Pass over some bytes, which must be there."""
        self._at += count
        if self._at > len(self._data):
            raise ValueError("it is cut off")

    def skip_metadata(self) -> None:
        """Pass over names and values that somebody has kept beside the geometry; blocks within blocks."""
        for _ in range(self.next()):
            self.next()  # of which attribute
            self._skip_blocks()
        self._skip_blocks()

    def _skip_blocks(self) -> None:
        open_blocks = 1
        while open_blocks:
            for _ in range(self.next()):
                self.skip(self.byte())
                self.skip(self.next())
            open_blocks += self.next() - 1
            if open_blocks > len(self._data):
                raise ValueError("its metadata has no end")
            if open_blocks:  # every block within a block has a name
                self.skip(self.byte())
