"""The uploaded file with some of its animations taken out and others put in, and nothing else changed."""

import json
import struct
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from jaxtyping import Float, Shaped

from caesura.core.limits import Limits
from caesura.formats.clips.animation_only import strip_meshes
from caesura.formats.clips.binary_chunk import BinaryChunk, without_unused
from caesura.formats.clips.buffer_references import exclusive_accessors, parts
from caesura.formats.clips.self_contained_gltf import SelfContainedGltf
from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.writer import COMPONENTS
from caesura.formats.read import find_main_part

UNUSED_ACCESSOR = {"componentType": 5126, "count": 1, "type": "SCALAR"}
"""What stands in the place of an accessor that is gone, so that the numbers of the others stay."""


class AnimationReplacement:
    """`remove` takes animations out, `add` puts others in, `pieces` are the GLB.

    The file has been read before, so its limits are not asked again.
    """

    def __init__(self, upload: Mapping[str, memoryview], *, animation_only: bool = False) -> None:
        beside = dict(upload)
        self.document = GltfDocument(beside.pop(find_main_part(upload)), beside, Limits.none())
        self.accessors = Accessors(self.document)
        self._file = SelfContainedGltf(self.document)
        self._bare = animation_only
        self._free: list[int] = []
        self._opened: set[int] = set()
        self._new: list[tuple[dict[str, Any], bytes]] = []
        self._known: dict[tuple[Any, ...], int] = {}
        self._staying: list[int] = []
        self._added: dict[int, list[dict[str, Any]]] = {}
        if animation_only:
            strip_meshes(self._file)

    def remove(self, removed: set[int]) -> None:
        """Take animations out by their numbers."""
        animations = self._file.json.get("animations", [])
        gone = [animations[number] for number in sorted(removed)]
        self._staying = [number for number in range(len(animations)) if number not in removed]
        self._file.json["animations"] = [animations[number] for number in self._staying]
        if not self._bare:
            self._free = exclusive_accessors(self._file.json, gone)
            accessors = self._file.json.get("accessors", [])
            self._opened = {part["bufferView"] for number in self._free for part, _ in parts(accessors[number])}

    def add(self, take: int, animations: list[dict[str, Any]]) -> None:
        """Put animations in where the animation `take` was, or after it."""
        self._added[take] = animations

    def window(self, layout: AccessorLayout, first: int, count: int) -> int | None:
        """An accessor of `count` elements of another, from number `first` on; None where it cannot be looked into."""
        entry = layout.entry.value
        if self._bare or "bufferView" not in entry or "sparse" in entry:
            return None
        start = entry.get("byteOffset", 0) + first * layout.width * layout.dtype.itemsize
        kept: dict[str, Any] = {name: entry[name] for name in ("bufferView", "componentType", "type")}
        more = ({"normalized": True} if layout.normalized else {}) | ({"byteOffset": start} if start else {})
        return self._accessor({**kept, **more, "count": count}, b"")

    def times(self, seconds: Float[np.ndarray, "keys"]) -> int:
        """An accessor of key times, with the bounds that they must have."""
        return self.array(seconds, "SCALAR", 1, {"min": [float(seconds[0])], "max": [float(seconds[-1])]})

    def array(self, values: Shaped[np.ndarray, "..."], kind: str, width: int, more: dict[str, Any]) -> int:
        """An accessor of new numbers, elements of `width` each."""
        data = np.ascontiguousarray(values).astype(values.dtype.newbyteorder("<")).tobytes()
        accessor = {"componentType": COMPONENTS[values.dtype.name], "count": values.size // width, "type": kind}
        return self._accessor(accessor | more, data)

    def pieces(self) -> Iterator[bytes]:
        """The GLB."""
        root = self._file.json
        for number in self._free:
            root["accessors"][number] = dict(UNUSED_ACCESSOR)
        chunk = without_unused(self._file, self._opened)
        self._append_new(chunk)
        root["animations"] = self._ordered()
        if chunk.length:
            root["buffers"][0]["byteLength"] = chunk.length
        else:
            root["buffers"] = root["buffers"][1:]
        for name in [name for name in ("buffers", "bufferViews", "accessors") if not root.get(name)]:
            root.pop(name, None)
        text = _text(root)
        text += b" " * (-len(text) % 4)
        padding = -chunk.length % 4
        binary = 8 + chunk.length + padding if chunk.length else 0
        yield struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + binary)
        yield struct.pack("<I4s", len(text), b"JSON") + text
        if binary:
            yield struct.pack("<I4s", chunk.length + padding, b"BIN\0")
            yield from filter(None, chunk.content())
            yield bytes(padding)

    def _accessor(self, accessor: dict[str, Any], data: bytes) -> int:
        """Its number; the same numbers again are the same accessor."""
        key = (data, tuple((name, str(value)) for name, value in accessor.items()))
        if key not in self._known:
            accessors = self._file.json.setdefault("accessors", [])
            if not self._free:
                self._free.append(len(accessors))
                accessors.append({})
            self._known[key] = self._free.pop(0)
            accessors[self._known[key]] = accessor
            if data:
                self._new.append((accessor, data))
        return self._known[key]

    def _append_new(self, chunk: BinaryChunk) -> None:
        """Put all new arrays into one view behind what was there."""
        if not self._new:
            return
        views = self._file.json.setdefault("bufferViews", [])
        places = [chunk.append(data) for _, data in self._new]
        for (accessor, _), place in zip(self._new, places, strict=True):
            offset = {"byteOffset": place - places[0]} if place > places[0] else {}
            accessor.update({"bufferView": len(views)} | offset)
        views.append({"buffer": 0, "byteOffset": places[0], "byteLength": chunk.length - places[0]})

    def _ordered(self) -> list[dict[str, Any]]:
        """Animations that stay and animations put in, in the order of the file's own."""
        staying = dict(zip(self._staying, self._file.json["animations"], strict=True))
        return [
            animation
            for number in range(len(self.document.animations))
            for animation in [*([staying[number]] if number in staying else []), *self._added.get(number, [])]
        ]


def _text(root: dict[str, Any]) -> bytes:
    """The JSON in as few bytes as it takes; half a letter, which JSON may say but UTF-8 cannot, stays a number."""
    try:
        return json.dumps(root, separators=(",", ":"), allow_nan=False, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        return json.dumps(root, separators=(",", ":"), allow_nan=False).encode()
