"""A GLB written as a stream: what is long is read when its turn comes, so that no more than one array is held.

Sizes are known beforehand, so the JSON can come first. `GlbWriter` is the plainer way where all fits in memory.
"""

import json
import struct
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from jaxtyping import Shaped

from caesura.formats.gltf.writer import COMPONENTS, SHAPES

DrawValues = Callable[[], Shaped[np.ndarray, "..."]]


class GlbStream:
    """Collects parts; every method answers the index that later parts refer to. `pieces` are the file."""

    def __init__(self) -> None:
        self.parts: dict[str, list[dict[str, Any]]] = {}
        self.extensions: set[str] = set()
        """The names of those that are used."""
        self._draws: list[tuple[int, DrawValues]] = []
        self._length = 0

    def add(self, kind: str, part: dict[str, Any]) -> int:
        """One more of the list `kind`."""
        parts = self.parts.setdefault(kind, [])
        parts.append(part)
        return len(parts) - 1

    def array(self, values: Shaped[np.ndarray, "..."], *, bounds: bool = False) -> int:
        """An accessor of values that are at hand; `bounds` adds min and max."""
        extent = {}
        if bounds:
            flat = values.reshape(len(values), -1)
            extent = {"min": flat.min(axis=0).tolist(), "max": flat.max(axis=0).tolist()}
        return self.streamed_accessor(values.dtype.name, values.shape, lambda: values, **extent)

    def streamed_accessor(self, dtype: str, shape: tuple[int, ...], draw: DrawValues, **more: Any) -> int:
        """An accessor whose values, of this type and shape, are drawn when they are written."""
        view = self._view(int(np.dtype(dtype).itemsize * np.prod(shape)), draw)
        kind = {"componentType": COMPONENTS[dtype], "count": shape[0], "type": SHAPES[shape[1:]]}
        return self.add("accessors", {"bufferView": view, **kind, **more})

    def view(self, data: memoryview) -> int:
        """A buffer view of bytes as they are, such as an image."""
        return self._view(len(data), lambda: np.frombuffer(data, np.uint8))

    def _view(self, size: int, draw: DrawValues) -> int:
        place = {"buffer": 0, "byteOffset": self._length, "byteLength": size}
        self._draws.append((size, draw))
        self._length += -(-size // 4) * 4
        return self.add("bufferViews", place)

    def pieces(self, roots: list[int]) -> Iterator[bytes]:
        """The file, with `roots` as the nodes of its one scene."""
        document = {
            "asset": {"version": "2.0", "generator": "Caesura"},
            "scene": 0,
            "scenes": [{"nodes": roots}],
            **({"extensionsUsed": sorted(self.extensions)} if self.extensions else {}),
            **self.parts,
            **({"buffers": [{"byteLength": self._length}]} if self._length else {}),
        }
        text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        binary = 8 + self._length if self._length else 0
        yield struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + binary)
        yield struct.pack("<I4s", len(text), b"JSON") + text
        if binary:
            yield struct.pack("<I4s", self._length, b"BIN\0")
        for size, draw in self._draws:
            data = np.ascontiguousarray(draw()).tobytes()
            if len(data) != size:
                raise AssertionError(f"{len(data)} bytes drawn where {size} were announced")
            yield data + bytes(-size % 4)
