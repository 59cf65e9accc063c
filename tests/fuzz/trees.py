"""Changes of JSON: the wrong number, kind or place at the places that a reader of glTF looks at."""

import copy
import random
from typing import Any

NUMBERS = (
    0, 1, -1, 2, 3, 4, 5, 7, 8, 12, 16, 100, 252, 255, 256, 65535, 65536, 10**5, 10**6, 2**31 - 1, 2**31, 2**32 - 1,
    2**32, 2**53, 2**62, 2**63, 2**64 - 8, 10**400, 0.0, -0.0, 0.5, 1.5, -1e-3, 1e-30, 1e30, 1e38, 3.5e38, 1e300,
    5120, 5121, 5122, 5123, 5125, 5126,
)  # fmt: skip
OTHERS = (
    None, True, False, "", "0", "SCALAR", "VEC2", "VEC3", "VEC4", "MAT4", "LINEAR", "STEP", "CUBICSPLINE",
    "translation", "rotation", "scale", "weights", "pointer", "ATTRIBUTES", "TRIANGLES", "INDICES", "QUATERNION",
    "OCTAHEDRAL", "EXPONENTIAL", "\ud800", "x" * 3000, "data:,", "data:application/octet-stream;base64,AAAA", "../x",
    float("nan"), float("inf"), [], {}, [0], [0, 0, 0, 0], [[]], {"": 0},
)  # fmt: skip
NAMES = (
    "sparse", "bufferView", "byteOffset", "byteStride", "byteLength", "count", "componentType", "type", "normalized",
    "mode", "indices", "attributes", "POSITION", "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1", "NORMAL", "targets",
    "weights", "mesh", "skin", "children", "matrix", "translation", "rotation", "scale", "joints",
    "inverseBindMatrices", "skeleton", "samplers", "channels", "sampler", "target", "node", "path", "input", "output",
    "interpolation", "uri", "extensions", "extensionsRequired", "extensionsUsed", "EXT_meshopt_compression",
    "KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing", "KHR_mesh_quantization", "name", "scene", "scenes",
    "nodes", "animations", "skins", "meshes", "accessors", "bufferViews", "buffers", "buffer", "values", "filter",
)  # fmt: skip


def changed(root: Any, draw: random.Random) -> Any:
    """The tree with one to four changes; its own lists and objects are changed."""
    for _ in range(draw.choice((1, 1, 1, 2, 2, 3, 4))):
        places = _places(root)
        if not places:
            return draw.choice(OTHERS)
        owner, key = draw.choice(places)
        draw.choice((_value, _value, _nudge, _nudge, _nudge, _drop, _copy, _elsewhere, _insert, _repeat))(
            owner, key, places, draw
        )
    return root


def _places(root: Any) -> list[tuple[Any, Any]]:
    """Every (list or object, place in it) of the tree."""
    found: list[tuple[Any, Any]] = []
    stack = [root]
    while stack and len(found) < 5000:
        owner = stack.pop()
        if isinstance(owner, dict):
            found += [(owner, key) for key in owner]
            stack += owner.values()
        elif isinstance(owner, list):
            found += [(owner, place) for place in range(len(owner))]
            stack += owner
    return found


def _value(owner: Any, key: Any, _: Any, draw: random.Random) -> None:
    owner[key] = copy.deepcopy(draw.choice(NUMBERS + OTHERS))


def _nudge(owner: Any, key: Any, _: Any, draw: random.Random) -> None:
    """Another value of its own kind, mostly near: it comes farther than nonsense does."""
    value = owner[key]
    if type(value) is int:
        owner[key] = draw.choice((value + 1, value - 1, value * 2, value // 2, -value, draw.choice(NUMBERS)))
    elif isinstance(value, float):
        owner[key] = draw.choice((-value, value * 1e9, value + 0.25, 0.0, draw.choice(NUMBERS)))
    elif isinstance(value, str):
        owner[key] = draw.choice((value + "x", value[:-1], draw.choice(NAMES), draw.choice(OTHERS)))
    elif isinstance(value, list) and value:
        draw.shuffle(value)
    else:
        _value(owner, key, _, draw)


def _drop(owner: Any, key: Any, _: Any, __: random.Random) -> None:
    del owner[key]


def _copy(owner: Any, key: Any, places: list[tuple[Any, Any]], draw: random.Random) -> None:
    """What stands somewhere else of the tree, here."""
    other, place = draw.choice(places)
    owner[key] = copy.deepcopy(other[place])


def _elsewhere(owner: Any, key: Any, places: list[tuple[Any, Any]], draw: random.Random) -> None:
    """Two places change what they hold, if they are of one object or list."""
    same = [place for other, place in places if other is owner]
    place = draw.choice(same)
    owner[key], owner[place] = owner[place], owner[key]


def _insert(owner: Any, key: Any, places: list[tuple[Any, Any]], draw: random.Random) -> None:
    """A member that glTF knows, with anything in it."""
    target = owner[key] if isinstance(owner[key], dict) else owner
    if isinstance(target, dict):
        other, place = draw.choice(places)
        value = draw.choice((draw.choice(NUMBERS), draw.choice(OTHERS), other[place]))
        target[draw.choice(NAMES)] = copy.deepcopy(value)
    else:
        target.insert(draw.randrange(len(target) + 1), copy.deepcopy(draw.choice(NUMBERS)))


def _repeat(owner: Any, key: Any, _: Any, draw: random.Random) -> None:
    """More of the same."""
    target = owner[key] if isinstance(owner[key], list) else owner
    if isinstance(target, list) and target:
        target += [copy.deepcopy(draw.choice(target)) for _ in range(draw.choice((1, 1, 2, 40)))]
