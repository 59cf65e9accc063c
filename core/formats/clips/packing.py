"""New arrays compressed by meshoptimizer's codec, where the file cannot be read without it anyway."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.formats.clips.binary_chunk import Room
from core.formats.gltf.document import COMPRESSED
from core.formats.gltf.meshopt.encoding.kernels import encoded
from core.formats.gltf.meshopt.view import LONGEST_ELEMENT

JSON_BYTES = 200
"""What a compressed view takes in the JSON, about."""


class Strip:
    """Arrays one after the other, in rows of so many bytes; `offsets` say where each begins."""

    def __init__(self, arrays: Iterable[bytes], row: int) -> None:
        room, self.data = Room(0, 2**63), bytearray()
        self.stride = row if row <= LONGEST_ELEMENT else 4
        self.offsets = []
        for array in arrays:
            at = room.take(array, row)
            self.data[at:] = array
            self.offsets.append(at)

    def packed(self) -> bytes | None:
        """Compressed, where it is worth it."""
        if not self.data or self.stride % 4 or len(self.data) % self.stride:
            return None
        stream = encoded(np.frombuffer(self.data, np.uint8).reshape(-1, self.stride)).tobytes()
        return stream if len(stream) + JSON_BYTES < len(self.data) else None


@dataclass
class Compression:
    """The extension by its `name`, and the buffer without bytes that stands for what comes out of it, so far used."""

    name: str
    buffer: int
    stand_in: dict[str, Any]
    used: int

    def view(self, strip: Strip, start: int, length: int) -> dict[str, Any]:
        """The view of a strip whose stream lies at `start` in the binary chunk."""
        offset, size = -(-self.used // 4) * 4, len(strip.data)
        self.used = self.stand_in["byteLength"] = offset + size
        stream = {
            "buffer": 0, "byteOffset": start, "byteLength": length,
            "byteStride": strip.stride, "count": size // strip.stride, "mode": "ATTRIBUTES",
        }  # fmt: skip
        return {"buffer": self.buffer, "byteOffset": offset, "byteLength": size, "extensions": {self.name: stream}}


def compression_of(root: dict[str, Any]) -> Compression | None:
    """What the file requires its readers to know, if it does."""
    for name in sorted(COMPRESSED & set(root.get("extensionsRequired", []))):
        for number, buffer in enumerate(root["buffers"]):
            if number and buffer.get("extensions", {}).get(name, {}).get("fallback") is True:
                views = [view for view in root["bufferViews"] if view["buffer"] == number]
                used = max((view.get("byteOffset", 0) + view["byteLength"] for view in views), default=0)
                return Compression(name, number, buffer, used)
    return None
