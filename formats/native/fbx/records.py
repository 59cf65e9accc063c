"""The records of a binary FBX, walked without what they hold. Light: no NumPy.

A record is where it ends, how many properties it has and how long they are, its name, the properties, and records
within it; from version 7500 on the numbers have eight bytes. See the notes on the format that Blender's authors
published in 2013.
"""

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import BinaryIO

MAGIC = b"Kaydara FBX Binary  \0\x1a"
FIRST = 27
MOST_RECORDS = 50_000
"""Records that are looked at, of one file; those within another count when they are asked for."""

LONGEST_PROPERTIES = 4096
SCALARS = {b"Y": "h", b"C": "?", b"I": "i", b"F": "f", b"D": "d", b"L": "q"}
ARRAYS = b"fdlibc"

Property = int | float | str | None
"""A number or a text; of an array, how many numbers it has."""


@dataclass(frozen=True)
class Record:
    """One record: its name, how many properties it has, where these begin and end, and where it ends itself."""

    name: str
    count: int
    properties: int
    inner: int
    end: int


class RecordWalker:
    """Walks records in order. What is broken ends the walk: to say what is wrong with it is the reader's."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        file.seek(0)
        head = file.read(FIRST)
        self._order = ">" if head[22:23] == b"\1" else "<"
        self.version = struct.unpack(f"{self._order}I", head[23:27])[0] if len(head) == FIRST else 0
        self._layout = struct.Struct(f"{self._order}{'QQQ' if self.version >= 7500 else 'III'}B")
        self._size = file.seek(0, 2)
        self._left = MOST_RECORDS

    def top(self) -> Iterator[Record]:
        """The outermost records."""
        return self._walk(FIRST, self._size)

    def within(self, record: Record) -> Iterator[Record]:
        """The records in another."""
        return self._walk(record.inner, record.end)

    def properties(self, record: Record) -> list[Property]:
        """The first properties of a record, as far as they are short."""
        self._file.seek(record.properties)
        data = self._file.read(min(record.inner - record.properties, LONGEST_PROPERTIES))
        found: list[Property] = []
        at = 0
        while at < len(data):
            kind, at = data[at : at + 1], at + 1
            if kind in SCALARS:
                layout = struct.Struct(self._order + SCALARS[kind])
                if at + layout.size > len(data):
                    break
                found.append(layout.unpack_from(data, at)[0])
                at += layout.size
            elif kind in b"SR" and at + 4 <= len(data):
                (length,) = struct.unpack_from(f"{self._order}I", data, at)
                found.append(data[at + 4 : at + 4 + length].decode("utf-8", "replace"))
                at += 4 + length
            elif kind in ARRAYS and at + 12 <= len(data):
                length, _, packed = struct.unpack_from(f"{self._order}III", data, at)
                found.append(length)
                at += 12 + packed
            else:
                break
        return found

    def _walk(self, at: int, end: int) -> Iterator[Record]:
        while at + self._layout.size <= end and self._left > 0:
            self._left -= 1
            self._file.seek(at)
            head = self._file.read(self._layout.size + 255)
            if len(head) < self._layout.size:
                return
            stop, count, length, letters = self._layout.unpack_from(head)
            properties = at + self._layout.size + letters
            if not properties + length <= stop <= end:  # also the record of zeros that ends a list
                return
            name = head[self._layout.size : self._layout.size + letters].decode("ascii", "replace")
            yield Record(name, count, properties, properties + length, stop)
            at = stop
