"""The joints of a file without a mesh: nodes that are animated, and all below them.

In a VRM animation (.vrma) some nodes stand for a face and its gaze: the x of a node's translation is the weight of an
expression, another node is what the eyes look at (VRMC_vrm_animation 1.0). These are no joints of the body.
"""

from collections.abc import Iterator, Sequence

from caesura.formats.gltf.animation.channels import Channel
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.gltf.json_object import JsonObject


def find_moving_joints(
    document: GltfDocument, nodes: list[int], parent: Sequence[int], channels: list[Channel]
) -> list[int]:
    """Of `nodes`, whose parents come first, those that `channels` move or carry along."""
    controls = _find_control_nodes(document)
    moving = {channel.node for channel in channels}
    if moving & controls:
        document.notices.add("vrm-controls-ignored", "What the file says of the face and of the eyes is left out.")
    moving -= controls
    joints = []
    for node in nodes:
        if node not in controls and (node in moving or parent[node] in moving):
            moving.add(node)
            joints.append(node)
    return joints


def _find_control_nodes(document: GltfDocument) -> set[int]:
    extension = document.root.extension("VRMC_vrm_animation")
    return {owner.index("node", len(document.nodes), "nodes") for owner in _controls(extension)} if extension else set()


def _controls(extension: JsonObject) -> Iterator[JsonObject]:
    expressions = extension.entry("expressions")
    kinds = [expressions.entry(kind) for kind in ("preset", "custom")] if expressions is not None else []
    groups = [group for group in kinds if group is not None]
    named = [group.entry(name) for group in groups for name in group.value]
    yield from (found for found in (extension.entry("lookAt"), *named) if found is not None and "node" in found)
