"""The accessors, views and bytes of a glTF that something refers to.

Numbers in the JSON are never changed, for an extension may name an accessor or a view in ways that are not known
here: any whole number within one that is not known is taken for such a name.
"""

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from caesura.formats.gltf.geometry.accessors import COMPONENTS, WIDTHS
from caesura.formats.gltf.gltf_document import IGNORABLE_EXTENSIONS

Range = tuple[int, int]

UNDERSTOOD = {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}
"""Extensions whose numbers are known for what they are."""


def exclusive_accessors(json: dict[str, Any], removed: list[dict[str, Any]]) -> list[int]:
    """Accessors that only the `removed` animations name; `json` is without them."""
    used = set(_accessors_of(json.get("animations", []))) | set(_numbers_in_extensions(json))
    for primitive in _primitives(json):
        for attributes in (primitive.get("attributes", {}), *primitive.get("targets", [])):
            used |= set(attributes.values())
        used.add(primitive.get("indices", -1))
    used |= {skin.get("inverseBindMatrices", -1) for skin in json.get("skins", [])}
    return sorted(set(_accessors_of(removed)) - used)


def views_beside_accessors(json: dict[str, Any]) -> set[int]:
    """Views with images, matrices or geometry in Draco's form, or that an extension may name."""
    images = {image["bufferView"] for image in json.get("images", []) if "bufferView" in image}
    matrices = {a.get("bufferView", -1) for a in json.get("accessors", []) if a["type"].startswith("MAT")}
    packed = [primitive.get("extensions", {}).get("KHR_draco_mesh_compression", {}) for primitive in _primitives(json)]
    geometry = {extension["bufferView"] for extension in packed if "bufferView" in extension}
    return images | matrices | geometry | set(_numbers_in_extensions(json))


def accessor_ranges(accessor: dict[str, Any]) -> Iterator[tuple[dict[str, Any], int]]:
    """What an accessor is made of: each object that names a view and an offset in it, and so many bytes there."""
    element = WIDTHS[accessor["type"]] * _size(accessor["componentType"])
    if "bufferView" in accessor:
        yield accessor, accessor["count"] * element
    if "sparse" in accessor:
        sparse = accessor["sparse"]
        yield sparse["indices"], sparse["count"] * _size(sparse["indices"]["componentType"])
        yield sparse["values"], sparse["count"] * element


def whole_view(view: dict[str, Any]) -> Iterator[Range]:
    """The bytes of a view in the binary chunk, and those it is decompressed from."""
    for part in (view, *view.get("extensions", {}).values()):
        if isinstance(part, dict) and part.get("buffer") == 0 and "byteLength" in part:
            yield part.get("byteOffset", 0), part.get("byteOffset", 0) + part["byteLength"]


def _numbers_in_extensions(value: Any, within: bool = False) -> Iterator[int]:
    """Every whole number that stands anywhere in an extension."""
    if type(value) is int and within:
        yield value
    elif isinstance(value, dict):
        for name, below in value.items():
            if not (name in UNDERSTOOD or name.startswith(IGNORABLE_EXTENSIONS)):
                yield from _numbers_in_extensions(below, within or name == "extensions")
    elif isinstance(value, list):
        for below in value:
            yield from _numbers_in_extensions(below, within)


def _primitives(json: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for mesh in json.get("meshes", []):
        yield from mesh.get("primitives", [])


def _accessors_of(animations: Iterable[dict[str, Any]]) -> Iterator[int]:
    for animation in animations:
        for sampler in animation.get("samplers", []):
            yield from (sampler[name] for name in ("input", "output") if name in sampler)


def _size(component: int) -> int:
    return np.dtype(COMPONENTS[component]).itemsize
