"""Key times straight out of a GLB, a few kilobytes at a time. Light: no NumPy."""

import struct
from itertools import pairwise
from typing import Any, BinaryIO

from caesura.formats.gltf.container import BINARY_CHUNK, CHUNK
from caesura.formats.gltf.json_object import FLOAT32_MAX

FLOAT = 5126
MOST_KEYS = 10_000
"""Keys that are asked for the rate of a take: a long one has no more to tell."""

MOST_KEYS_IN_ALL = 100_000
"""Keys that are read of all takes together; a file with more is told the rest by their bounds."""


class KeyTimeReader:
    """Reads the GLB `file`, whose JSON chunk ends at `end_of_json`."""

    def __init__(self, file: BinaryIO, end_of_json: int, json: dict[str, Any]) -> None:
        self._file = file
        self._json = json
        self._left = MOST_KEYS_IN_ALL
        self._start = end_of_json + CHUNK.size
        file.seek(end_of_json)
        chunk = file.read(CHUNK.size)
        length, kind = CHUNK.unpack(chunk) if len(chunk) == CHUNK.size else (0, 0)
        self._length = length if kind == BINARY_CHUNK else 0

    def __call__(self, accessor: Any) -> tuple[float, ...]:
        """Seconds of the first keys in an accessor, at most `MOST_KEYS`; none where they are not plain."""
        place = self._place(accessor)
        count = 0 if place is None else min(accessor["count"], MOST_KEYS)
        if place is None or count > self._left:
            return ()
        self._left -= count
        self._file.seek(self._start + place)
        data = self._file.read(4 * count)
        if len(data) < 4 * count:  # the chunk is longer than the file
            return ()
        times = struct.unpack(f"<{count}f", data)
        return times if all(0 <= a <= b <= FLOAT32_MAX for a, b in pairwise((0.0, *times))) else ()

    def _place(self, accessor: Any) -> int | None:
        """Where the floats of an accessor begin in the binary chunk, if they are there one after the other."""
        views: Any = self._json.get("bufferViews")
        try:
            view = views[accessor["bufferView"]]
            plain = accessor["componentType"] == FLOAT and accessor["type"] == "SCALAR" and view["buffer"] == 0
            start, length = view.get("byteOffset", 0), accessor["count"] * 4
            numbers = (accessor["bufferView"], accessor["count"], start, offset := accessor.get("byteOffset", 0))
        except (AttributeError, KeyError, IndexError, TypeError):
            return None
        odd = {"sparse"} & accessor.keys() or {"extensions", "byteStride"} & view.keys()
        if not plain or odd or any(type(number) is not int or number < 0 for number in numbers):
            return None
        return start + offset if start + offset + length <= self._length else None
