"""What the JSON of a glTF says with hardly any data: takes, and how large the scene is. Light: no NumPy.

Numbers are taken where they are plain and left out where they are not; what is wrong with them is the reader's to say.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from caesura.formats.gltf.json_object import FLOAT32_MAX, JsonObject
from caesura.formats.takes.frame_rate import estimate_key_rate, snap_frame_rate
from caesura.formats.takes.take_selection import take_name

TRIANGLES, FAN = 4, 6
INSTANCING = "EXT_mesh_gpu_instancing"


@dataclass(frozen=True)
class AnimationSummary:
    """One animation: seconds to its last key, and the rate of its keys where they are even."""

    name: str
    seconds: float
    rate: float | None


def summarise_animations(root: JsonObject, times: Callable[[Any], Sequence[float]]) -> list[AnimationSummary]:
    """All animations; `times` tells the keys of an accessor, or nothing, and its bounds and count are believed."""
    accessors = _list(root.value, "accessors")
    found = []
    for place, animation in enumerate(_list(root.value, "animations")):
        inputs = [accessors[number] for number in _inputs(accessors, animation)]
        densest = max(inputs, key=_count, default=None)
        keys = times(densest)
        seconds = max([*(_bound(accessor, "max") for accessor in inputs), *keys[-1:]], default=0.0)
        rate = estimate_key_rate(keys) if keys else _even_rate(densest)
        name = take_name(animation.get("name") if isinstance(animation, dict) else None, place)
        found.append(AnimationSummary(name, seconds if seconds <= FLOAT32_MAX else 0.0, rate))
    return found


def estimate_scene_size(root: JsonObject) -> tuple[int, int]:
    """Vertices and triangles of all nodes that have a mesh, as often as they draw it, in any scene."""
    accessors, meshes = _list(root.value, "accessors"), _list(root.value, "meshes")
    sizes = [_size_of_mesh(accessors, mesh) for mesh in meshes]
    nodes = _list(root.value, "nodes")
    used = [
        (sizes[number], _instance_count(accessors, node))
        for node in nodes
        if (number := _place(node, "mesh", len(meshes))) is not None
    ]
    return sum(times * size[0] for size, times in used), sum(times * size[1] for size, times in used)


def _instance_count(accessors: list[Any], node: Any) -> int:
    """How often a node draws its mesh."""
    if not isinstance(node, dict) or "skin" in node:
        return 1
    attributes = _member(_member(_member(node, "extensions", None), INSTANCING, None), "attributes", None)
    places = (_place(attributes, name, len(accessors)) for name in ("TRANSLATION", "ROTATION", "SCALE"))
    return next((_count(accessors[place]) for place in places if place is not None), 1)


def _size_of_mesh(accessors: list[Any], mesh: Any) -> tuple[int, int]:
    vertices = triangles = 0
    for primitive in _list(mesh, "primitives"):
        mode = _member(primitive, "mode", TRIANGLES)
        position = _place(_member(primitive, "attributes", None), "POSITION", len(accessors))
        if position is None or mode not in range(TRIANGLES, FAN + 1):
            continue
        indices = _place(primitive, "indices", len(accessors))
        corners = _count(accessors[position if indices is None else indices])
        vertices += _count(accessors[position])
        triangles += corners // 3 if mode == TRIANGLES else max(corners - 2, 0)
    return vertices, triangles


def _inputs(accessors: list[Any], animation: Any) -> list[int]:
    """The accessors that hold the key times of an animation's channels."""
    samplers = _list(animation, "samplers")
    used = dict.fromkeys(_place(channel, "sampler", len(samplers)) for channel in _list(animation, "channels"))
    inputs = (_place(samplers[place], "input", len(accessors)) for place in used if place is not None)
    return [place for place in dict.fromkeys(inputs) if place is not None]


def _even_rate(accessor: Any) -> float | None:
    """The rate of keys that are as many between their bounds as if one were on every frame."""
    keys, span = _count(accessor), _bound(accessor, "max") - _bound(accessor, "min")
    return snap_frame_rate((keys - 1) / span) if keys > 1 and span > 0 else None


def _bound(accessor: Any, name: str) -> float:
    bound = _list(accessor, name)[:1]
    usable = bound and type(bound[0]) in (int, float) and 0 <= bound[0] <= 1e300
    return float(bound[0]) if usable and math.isfinite(bound[0]) else 0.0


def _count(accessor: Any) -> int:
    count = _member(accessor, "count", 0)
    return count if type(count) is int and 0 <= count < 2**53 else 0


def _place(owner: Any, name: str, count: int) -> int | None:
    place = _member(owner, name, None)
    return place if type(place) is int and 0 <= place < count else None


def _list(owner: Any, name: str) -> list[Any]:
    value = _member(owner, name, [])
    return value if isinstance(value, list) else []


def _member(owner: Any, name: str, default: Any) -> Any:
    return owner.get(name, default) if isinstance(owner, dict) else default
