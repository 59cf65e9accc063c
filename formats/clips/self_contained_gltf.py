"""A glTF as one piece: every buffer that came with it becomes the binary chunk, every image beside it a part of it."""

import copy
from collections.abc import Iterator
from typing import Any
from urllib.parse import unquote

from caesura.core.errors import BrokenContainer
from caesura.formats.gltf.document import COMPRESSED, GltfDocument
from caesura.formats.gltf.geometry.buffers import Buffers

IMAGES = {
    "png": "image/png", "jpg": "image/jpeg", "jpeg": "image/jpeg", "webp": "image/webp", "ktx2": "image/ktx2",
}  # fmt: skip


class SelfContainedGltf:
    """`json` is a copy to be changed at will; `pieces` are (offset, bytes) of the binary chunk, `length` long."""

    def __init__(self, document: GltfDocument) -> None:
        self.json: dict[str, Any] = _copied(document.root.value)
        self.pieces: list[tuple[int, memoryview]] = []
        self.length = 0
        self._document = document
        self._join_buffers()
        self._take_in_images()

    def append(self, data: memoryview) -> int:
        """Add bytes, aligned as any number may ask for, and say where they are."""
        self.length += -self.length % 8
        self.pieces.append((self.length, data))
        self.length += len(data)
        return self.length - len(data)

    def _join_buffers(self) -> None:
        """All buffers one after the other, and views moved with them; a stand-in without bytes stays a buffer."""
        opened = Buffers(self._document)
        shifts: dict[int, int] = {}
        stand_ins = []
        named = {part["buffer"] for view in self.json.get("bufferViews", []) for part in byte_ranges_of_view(view)}
        for index, entry in enumerate(self._document.buffers):
            if "uri" not in entry and (index or not self._document.is_glb):
                stand_ins.append(index)
            elif index in named:
                shifts[index] = self.append(opened.buffer(index))
        places = {index: (0, shift) for index, shift in shifts.items()}
        places |= {index: (1 + rank, 0) for rank, index in enumerate(stand_ins)}
        for view in self.json.get("bufferViews", []):
            for part in byte_ranges_of_view(view):
                part["buffer"], shift = places[part["buffer"]]
                if shift:
                    part["byteOffset"] = part.get("byteOffset", 0) + shift
        kept = [self.json["buffers"][index] for index in stand_ins]
        first = {k: v for k, v in self.json["buffers"][0].items() if k != "uri"} if self._document.buffers else {}
        self.json["buffers"] = [{} if stand_ins[:1] == [0] else first, *kept]

    def _take_in_images(self) -> None:
        """An image sent beside the model goes into it; one that was not sent, or is on nothing, keeps its address."""
        for number, image in enumerate(self.json.get("images", [])):
            if not self._shows(number):
                continue
            uri = image.get("uri")
            name = next((n for n in (uri, unquote(uri)) if n in self._document.parts), "") if uri else ""
            kind = image.get("mimeType") or IMAGES.get(name.rpartition(".")[2].lower())
            if not name or not kind:
                continue
            data = self._document.parts[name]
            views = self.json.setdefault("bufferViews", [])
            views.append({"buffer": 0, "byteOffset": self.append(data), "byteLength": len(data)})
            del image["uri"]
            image |= {"bufferView": len(views) - 1, "mimeType": kind}

    def _shows(self, image: int) -> bool:
        """Whether a texture has the image, by itself or by an extension, or an extension of the file may."""
        textures = self.json.get("textures", [])
        named = (kind.get("source") for t in textures for kind in (t, *t.get("extensions", {}).values()))
        return image in named or bool(self.json.get("extensions"))


def byte_ranges_of_view(view: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """What of a view says where bytes are: itself, and the extensions that compress it."""
    yield view
    for name in COMPRESSED & view.get("extensions", {}).keys():
        if "buffer" in view["extensions"][name]:
            yield view["extensions"][name]


def _copied(value: dict[str, Any]) -> dict[str, Any]:
    """All of it, to be changed; refused where it is nested deeper than can be copied, though it could be read."""
    try:
        return copy.deepcopy(value)
    except RecursionError:
        raise BrokenContainer("malformed-json", "The JSON is nested too deeply. Export the file again.") from None
