"""Which accessors, views and bytes only the animations taken out have used, so that clips can take their place.

Numbers in the JSON are never changed, for an extension may name an accessor or a view in ways that are not known
here: any whole number within one that is not known is taken for such a name.
"""

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from core.formats.gltf.accessors import COMPONENTS, WIDTHS
from core.formats.gltf.document import HARMLESS

Range = tuple[int, int]

UNDERSTOOD = {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}
"""Extensions whose numbers are known for what they are."""


def freed_accessors(json: dict[str, Any], removed: list[dict[str, Any]]) -> list[int]:
    """Accessors that only the `removed` animations name; `json` is without them."""
    used = set(_accessors_of(json.get("animations", []))) | set(numbers_in_extensions(json))
    for mesh in json.get("meshes", []):
        for primitive in mesh.get("primitives", []):
            for attributes in (primitive.get("attributes", {}), *primitive.get("targets", [])):
                used |= set(attributes.values())
            used.add(primitive.get("indices", -1))
    used |= {skin.get("inverseBindMatrices", -1) for skin in json.get("skins", [])}
    return sorted(set(_accessors_of(removed)) - used)


def free_ranges(json: dict[str, Any], freed: Iterable[int], windows: Iterable[dict[str, Any]]) -> list[Range]:
    """Bytes of the binary chunk where freed accessors lay, and nothing else does; `windows` are accessors to come."""
    freed = set(freed)
    accessors: list[dict[str, Any]] = json.get("accessors", [])
    gone = [accessors[number] for number in freed]
    kept = [accessor for number, accessor in enumerate(accessors) if number not in freed]
    views = json.get("bufferViews", [])
    looked_into = {view for accessor in gone for view, _, _ in places(accessor)} - _opaque_views(json)

    def ranges(named: Iterable[dict[str, Any]]) -> list[Range]:
        found = (place for accessor in named for place in places(accessor))
        return [_at(views, view, start, size) for view, start, size in found if view in looked_into]

    used = ranges([*kept, *windows])
    used += [r for number in set(range(len(views))) - looked_into for r in whole_view(views[number])]
    free = ranges(gone)
    return list(without(joined(free), joined(used)))


def unused_views(json: dict[str, Any], freed: Iterable[int], windows: Iterable[dict[str, Any]]) -> list[int]:
    """Views that only freed accessors named."""
    freed = set(freed)
    accessors = list(enumerate(json.get("accessors", [])))
    before = {view for number, accessor in accessors if number in freed for view, _, _ in places(accessor)}
    after = {view for number, accessor in accessors if number not in freed for view, _, _ in places(accessor)}
    after |= {view for accessor in windows for view, _, _ in places(accessor)}
    return sorted(before - after - _opaque_views(json))


def numbers_in_extensions(value: Any, within: bool = False) -> Iterator[int]:
    """Every whole number that stands anywhere in an extension."""
    if type(value) is int and within:
        yield value
    elif isinstance(value, dict):
        for name, below in value.items():
            if not (name in UNDERSTOOD or name.startswith(HARMLESS)):
                yield from numbers_in_extensions(below, within or name == "extensions")
    elif isinstance(value, list):
        for below in value:
            yield from numbers_in_extensions(below, within)


def _opaque_views(json: dict[str, Any]) -> set[int]:
    """Views with elements apart, compressed, in another buffer, or named by others: not looked into."""
    odd = {
        n for n, v in enumerate(json.get("bufferViews", [])) if {"extensions", "byteStride"} & v.keys() or v["buffer"]
    }
    return odd | views_of_others(json)


def views_of_others(json: dict[str, Any]) -> set[int]:
    """Views with images, matrices or geometry in Draco's form, or that an extension may name."""
    images = {image["bufferView"] for image in json.get("images", []) if "bufferView" in image}
    matrices = {a.get("bufferView", -1) for a in json.get("accessors", []) if a["type"].startswith("MAT")}
    return images | matrices | _compressed(json) | set(numbers_in_extensions(json))


def _compressed(json: dict[str, Any]) -> set[int]:
    """Views with geometry compressed by Draco."""
    primitives = [primitive for mesh in json.get("meshes", []) for primitive in mesh.get("primitives", [])]
    found = [primitive.get("extensions", {}).get("KHR_draco_mesh_compression", {}) for primitive in primitives]
    return {extension["bufferView"] for extension in found if "bufferView" in extension}


def _accessors_of(animations: Iterable[dict[str, Any]]) -> Iterator[int]:
    for animation in animations:
        for sampler in animation.get("samplers", []):
            yield from (sampler[name] for name in ("input", "output") if name in sampler)


def places(accessor: dict[str, Any]) -> Iterator[tuple[int, int, int]]:
    """View, offset in it and size of what an accessor is made of."""
    element = WIDTHS[accessor["type"]] * _size(accessor["componentType"])
    if "bufferView" in accessor:
        yield accessor["bufferView"], accessor.get("byteOffset", 0), accessor["count"] * element
    if "sparse" in accessor:
        sparse = accessor["sparse"]
        indices, values = sparse["indices"], sparse["values"]
        yield indices["bufferView"], indices.get("byteOffset", 0), sparse["count"] * _size(indices["componentType"])
        yield values["bufferView"], values.get("byteOffset", 0), sparse["count"] * element


def _size(component: int) -> int:
    return np.dtype(COMPONENTS[component]).itemsize


def _at(views: list[dict[str, Any]], view: int, start: int, size: int) -> Range:
    begin = views[view].get("byteOffset", 0) + start
    return begin, begin + size


def whole_view(view: dict[str, Any]) -> Iterator[Range]:
    """The bytes of a view in the binary chunk, and those it is decompressed from."""
    for part in (view, *view.get("extensions", {}).values()):
        if isinstance(part, dict) and part.get("buffer") == 0 and "byteLength" in part:
            yield part.get("byteOffset", 0), part.get("byteOffset", 0) + part["byteLength"]


def joined(ranges: Iterable[Range]) -> list[Range]:
    """The same bytes as few ranges, in order and apart."""
    joined: list[Range] = []
    for start, end in sorted(ranges):
        if joined and start <= joined[-1][1]:
            joined[-1] = (joined[-1][0], max(joined[-1][1], end))
        elif end > start:
            joined.append((start, end))
    return joined


def without(free: Iterable[Range], used: list[Range]) -> Iterator[Range]:
    """What of `free` is not in `used`; both are in order and apart."""
    first = 0
    for start, end in free:
        while first < len(used) and used[first][1] <= start:
            first += 1
        taken = [(max(a, start), min(b, end)) for a, b in used[first : _beyond(used, first, end)]]
        for (_, left), (right, _) in pairwise([(start, start), *taken, (end, end)]):
            if right > left:
                yield left, right


def _beyond(used: list[Range], first: int, end: int) -> int:
    while first < len(used) and used[first][0] < end:
        first += 1
    return first
