"""Two files of one upload: the mesh and its skin from one, the animation from the other, joints matched by name."""

import copy
import json
from collections import Counter
from collections.abc import Mapping
from typing import Any, NamedTuple

from caesura.core.errors import BrokenContainer, InvalidModel
from caesura.core.limits import Limits
from caesura.core.segmentation_document import Notice
from caesura.formats.gltf.container import Container, open_container
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.notices import Notices

BINARY = {"mesh": "binary chunk of the mesh", "skeleton": "binary chunk of the skeleton"}
LISTS = ("buffers", "bufferViews", "accessors")


class MeshMotionPair(NamedTuple):
    """One glTF made of two; `parts` are their binary chunks, by the names that it calls them."""

    json: bytes
    parts: Mapping[str, memoryview]
    notice: Notice


def pair_mesh_and_motion(first: memoryview, second: memoryview, limits: Limits) -> MeshMotionPair:
    """The mesh of one of two glTF files, moved by the animations of the other.

    Raises `ambiguous-upload` where it is not plain which is which, `unmatched-skeleton` where no name is in both.
    """
    opened = [open_container(data, limits, Notices()) for data in (first, second)]
    mesh, skeleton = opened if _has_mesh_only(opened[0].root, opened[1].root) else opened[::-1]
    if not _has_mesh_only(mesh.root, skeleton.root):
        raise InvalidModel(
            "ambiguous-upload",
            "Both files have a mesh and an animation, or neither. Send one of them, or a mesh and its motion.",
        )
    try:
        return _merge_animation(mesh, skeleton)
    except RecursionError:
        raise BrokenContainer("malformed-json", "The JSON is nested too deeply. Export the file again.") from None


def _merge_animation(mesh: Container, skeleton: Container) -> MeshMotionPair:
    parts = {BINARY[name]: found.binary for name, found in (("mesh", mesh), ("skeleton", skeleton)) if found.binary}
    merged = _name_binary_chunk(mesh.root, BINARY["mesh"] if mesh.is_glb else None)
    moving = _name_binary_chunk(skeleton.root, BINARY["skeleton"] if skeleton.is_glb else None)
    counts = {name: len(mesh.root.entries(name)) for name in LISTS}
    for name in LISTS:
        skeleton.root.entries(name)  # objects, or refused
        merged[name] = [*merged.get(name, []), *(_shift_indices(part, counts) for part in moving.get(name, []))]
    merged["animations"], matched, lost = _animations(mesh.root, skeleton.root, moving, counts["accessors"])
    merged["extensionsRequired"] = [
        name for found in (mesh, skeleton) for name in found.root.values("extensionsRequired")
    ]
    detail = f"The mesh is of one file and the motion of the other; {matched} of its nodes were found by name."
    if lost:
        detail += f" {lost} were not, and do not move."
    return MeshMotionPair(json.dumps(merged).encode(), parts, Notice(code="skeleton-paired", detail=detail))


def _has_mesh_only(mesh: JsonObject, skeleton: JsonObject) -> bool:
    """Whether one has the mesh and the other the animation, and not both have both."""
    both = bool(mesh.values("animations")) and bool(skeleton.values("meshes"))
    return bool(mesh.values("meshes")) and bool(skeleton.values("animations")) and not both


def _name_binary_chunk(root: JsonObject, binary: str | None) -> dict[str, Any]:
    """The JSON, the binary chunk of a GLB called by a name."""
    value = copy.deepcopy(root.value)
    root.entries("buffers")
    if binary is not None and value.get("buffers") and "uri" not in value["buffers"][0]:
        value["buffers"][0]["uri"] = binary
    return value


def _shift_indices(part: Any, counts: dict[str, int]) -> Any:
    """The same with its places in lists moved behind those of the mesh, wherever they stand in it."""
    if isinstance(part, dict):
        moves = {"buffer": counts["buffers"], "bufferView": counts["bufferViews"]}
        return {
            name: value + moves[name]
            if name in moves and type(value) is int and value >= 0
            else _shift_indices(value, counts)
            for name, value in part.items()
        }
    return part


def _animations(
    mesh: JsonObject, skeleton: JsonObject, moving: dict[str, Any], shift: int
) -> tuple[list[dict[str, Any]], int, int]:
    """The animations with their nodes and accessors in the mesh's file, and how many nodes were and were not there."""
    names = [entry.value.get("name") for entry in mesh.entries("nodes")]
    times = Counter(name for name in names if isinstance(name, str))
    places = {name: place for place, name in enumerate(names) if isinstance(name, str) and times[name] == 1}
    nodes = skeleton.entries("nodes")
    found: set[str] = set()
    lost: set[object] = set()
    animations = []
    for animation, value in zip(skeleton.entries("animations"), moving["animations"], strict=True):
        for sampler in animation.entries("samplers"):
            for end in ("input", "output"):
                sampler.index(end, len(skeleton.values("accessors")), "accessors", "invalid-animation")
        kept = []
        for channel in animation.entries("channels"):
            target = channel.entry("target")
            if target is None or "node" not in target:
                continue
            name = nodes[target.index("node", len(nodes), "nodes", "invalid-animation")].value.get("name")
            if isinstance(name, str) and name in places:
                found.add(name)
                kept.append({**channel.value, "target": {**target.value, "node": places[name]}})
            else:
                lost.add(name if isinstance(name, str) else None)
        samplers = [
            {**s, "input": s["input"] + shift, "output": s["output"] + shift} for s in value.get("samplers", [])
        ]
        animations.append({**value, "samplers": samplers, "channels": kept})
    if not found:
        raise InvalidModel(
            "unmatched-skeleton", "No node that is animated in one file has the name of a node of the other."
        )
    return animations, len(found), len(lost)
