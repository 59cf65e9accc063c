"""The materials of a glTF as the page shows them: plain in the playable copy, and whole in a GLB of their own.

Images come in the second file alone, so that the figure is there before them. What is faulty, too large, or of an
extension that the page does not draw is left out: a material never keeps a take from being played.
"""

import base64
import binascii
from collections.abc import Iterator
from typing import Any
from urllib.parse import unquote

from caesura.core.errors import InputError
from caesura.formats.gltf.geometry.buffers import Buffers
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.playback.glb_stream import GlbStream
from caesura.formats.playback.image_header import read_image_header

LARGEST_SIDE = 8192
"""Pixels of an image that is shown."""
MOST_IMAGE_BYTES = 64 * 2**20
"""Of all images together, as they are stored."""
MOST_TEXTURE_COORDINATES = 4
"""Sets of texture coordinates that three.js knows."""

EXTENSIONS = {"KHR_materials_unlit", "KHR_materials_emissive_strength", "KHR_texture_transform"}
"""Those that are copied."""

COLOUR_MAPS = ("baseColorTexture", "metallicRoughnessTexture")
OTHER_MAPS = ("normalTexture", "occlusionTexture", "emissiveTexture")
SAMPLER = ("magFilter", "minFilter", "wrapS", "wrapT")


class Materials:
    """The materials that `number` was asked for, numbered in that order."""

    def __init__(self, document: GltfDocument) -> None:
        self._document = document
        self._buffers = Buffers(document)
        self._numbers: dict[int, int] = {}

    def number(self, primitive: JsonObject) -> int | None:
        """The number of a primitive's material; None where it has none that can be read."""
        try:
            if "material" not in primitive:
                return None
            index = primitive.index("material", len(self._document.root.entries("materials")), "materials")
        except InputError:
            return None
        return self._numbers.setdefault(index, len(self._numbers))

    def plain(self) -> list[dict[str, Any]]:
        """The materials without images; `extras.number` is the number of each."""
        return [_material(entry, None) | {"extras": {"number": n}} for n, entry in enumerate(self._entries())]

    def textured(self) -> Iterator[bytes] | None:
        """A GLB of the same materials with their images, piece by piece; None where there is no image."""
        out = GlbStream()
        out.extensions |= EXTENSIONS
        textures = _Textures(self._document, self._buffers, out)
        for number, entry in enumerate(self._entries()):
            out.add("materials", _material(entry, textures) | {"extras": {"number": number}})
        return out.pieces([]) if "images" in out.parts else None

    def _entries(self) -> list[JsonObject]:
        materials = self._document.root.entries("materials")
        return [materials[index] for index in self._numbers]


class _Textures:
    """The textures of one file, copied as they are asked for."""

    def __init__(self, document: GltfDocument, buffers: Buffers, out: GlbStream) -> None:
        self._document = document
        self._buffers = buffers
        self._out = out
        self._copies: dict[int, int | None] = {}
        self._images: dict[int, int | None] = {}
        self._room = MOST_IMAGE_BYTES

    def copy(self, used: JsonObject) -> int | None:
        """The number of the copy of the texture that is used; None where it has no image that can be shown."""
        textures = self._document.root.entries("textures")
        index = used.index("index", len(textures), "textures")
        if index not in self._copies:
            self._copies[index] = self._copy(textures[index])
        return self._copies[index]

    def _copy(self, texture: JsonObject) -> int | None:
        source = next((t for t in (texture, texture.extension("EXT_texture_webp")) if t and "source" in t), None)
        if source is None:
            return None
        sampler = self._sampler(texture)
        number = source.index("source", len(self._document.root.entries("images")), "images")
        if number not in self._images:
            self._images[number] = self._image(self._document.root.entries("images")[number])
        image = self._images[number]
        if image is None:
            return None
        return self._out.add("textures", {"source": image, "sampler": self._out.add("samplers", sampler)})

    def _sampler(self, texture: JsonObject) -> dict[str, Any]:
        """How a texture is read between its pixels and beyond its edges."""
        if "sampler" not in texture:
            return {}
        samplers = self._document.root.entries("samplers")
        given = samplers[texture.index("sampler", len(samplers), "samplers")]
        return {name: given.whole(name) for name in SAMPLER if name in given}

    def _image(self, image: JsonObject) -> int | None:
        data = self._bytes(image)
        header = None if data is None or len(data) > self._room else read_image_header(data)
        if data is None or header is None or not 0 < max(header.width, header.height) <= LARGEST_SIDE:
            return None
        self._room -= len(data)
        return self._out.add("images", {"mimeType": header.media_type, "bufferView": self._out.view(data)})

    def _bytes(self, image: JsonObject) -> memoryview | None:
        """Of a view, of a data: URI, or of a file that was sent beside the model."""
        if "bufferView" in image:
            return self._buffers.view(image.index("bufferView", len(self._document.views), "bufferViews"))
        uri = image.text("uri", "")
        if uri[:5].lower() == "data:":
            try:
                return memoryview(base64.b64decode(unquote(uri.partition(",")[2]), validate=True))
            except (binascii.Error, ValueError):
                return None
        return next((self._document.parts[n] for n in (uri, unquote(uri)) if n in self._document.parts), None)


def _material(entry: JsonObject, textures: _Textures | None) -> dict[str, Any]:
    """A material of what can be read of it; the default one where nothing can."""
    try:
        return _colours(entry, textures) | _surface(entry, textures)
    except InputError:
        return {}


def _colours(entry: JsonObject, textures: _Textures | None) -> dict[str, Any]:
    given = entry.entry("pbrMetallicRoughness") or JsonObject({}, entry.pointer)
    colours: dict[str, Any] = {
        "baseColorFactor": list(given.numbers("baseColorFactor", 4, (1, 1, 1, 1))),
        "metallicFactor": _number(given, "metallicFactor", 1),
        "roughnessFactor": _number(given, "roughnessFactor", 1),
    }
    return {"pbrMetallicRoughness": colours | _maps(given, COLOUR_MAPS, textures)}


def _surface(entry: JsonObject, textures: _Textures | None) -> dict[str, Any]:
    """All but the colours: what it gives off, what shines through it, and how its light is computed."""
    extensions: dict[str, Any] = {}
    if entry.extension("KHR_materials_unlit") is not None:
        extensions["KHR_materials_unlit"] = {}
    strength = entry.extension("KHR_materials_emissive_strength")
    if strength is not None:
        extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": _number(strength, "emissiveStrength", 1)}
    return {
        "emissiveFactor": list(entry.numbers("emissiveFactor", 3, (0, 0, 0))),
        "alphaMode": entry.choice("alphaMode", ("OPAQUE", "MASK", "BLEND"), "OPAQUE"),
        "doubleSided": entry.flag("doubleSided"),
        **({"alphaCutoff": _number(entry, "alphaCutoff", 0.5)} if entry.value.get("alphaMode") == "MASK" else {}),
        **({"extensions": extensions} if extensions else {}),
        **_maps(entry, OTHER_MAPS, textures),
    }


def _maps(entry: JsonObject, names: tuple[str, ...], textures: _Textures | None) -> dict[str, Any]:
    """The textures of a material under the same names."""
    found: dict[str, Any] = {}
    for name in names:
        given = entry.entry(name)
        if given is None or textures is None:
            continue
        index = textures.copy(given)
        if index is not None:
            found[name] = {"index": index, "texCoord": _coordinates(given)} | _placement(given)
            found[name] |= {k: _number(given, k, 1) for k in ("scale", "strength") if k in given}
    return found


def _placement(given: JsonObject) -> dict[str, Any]:
    """How a texture is moved, turned and scaled on the surface."""
    transform = given.extension("KHR_texture_transform")
    if transform is None:
        return {}
    moved: dict[str, Any] = {
        "offset": list(transform.numbers("offset", 2, (0, 0))),
        "rotation": _number(transform, "rotation", 0),
        "scale": list(transform.numbers("scale", 2, (1, 1))),
    }
    if "texCoord" in transform:
        moved["texCoord"] = _coordinates(transform)
    return {"extensions": {"KHR_texture_transform": moved}}


def _coordinates(given: JsonObject) -> int:
    return min(given.whole("texCoord", 0), MOST_TEXTURE_COORDINATES - 1)


def _number(entry: JsonObject, name: str, default: float) -> float:
    given = {name: [entry.value[name]]} if name in entry else {}
    return JsonObject(given, entry.pointer).numbers(name, 1, (default,))[0]
