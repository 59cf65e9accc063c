"""A glTF stripped to its nodes: what engines take as animations for a model that they have already."""

from caesura.formats.clips.self_contained_gltf import SelfContainedGltf

KEPT = ("asset", "scene", "scenes", "nodes", "animations", "extras")
PLACEMENT = ("name", "children", "translation", "rotation", "scale", "matrix", "extras")


def strip_meshes(file: SelfContainedGltf) -> None:
    """Leave nodes, their places and their names; no meshes, skins, materials, or bytes."""
    file.json = {name: file.json[name] for name in KEPT if name in file.json}
    file.json["nodes"] = [{k: node[k] for k in PLACEMENT if k in node} for node in file.json.get("nodes", [])]
    for scene in file.json.get("scenes", []):
        scene.pop("extensions", None)
    file.json["buffers"] = [{}]
    file.pieces, file.length = [], 0


def targets_node(path: str) -> bool:
    """Whether a channel has a meaning without meshes."""
    return path in {"translation", "rotation", "scale"}
