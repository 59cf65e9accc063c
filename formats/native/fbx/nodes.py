"""Nodes of the scene: each one's place in its parent, as translation, rotation and scale.

An FBX places a node by pivots, offsets, a rotation before and one after, in any order of axes; the library makes one
translation, rotation and scale of them. A node that does not inherit its parent's scale gets a parent beside it, a
helper without that scale.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.gltf.writer import GlbWriter
from caesura.formats.native.fbx.held_objects import all_held, held


@dataclass(frozen=True)
class SceneNode:
    """A node of the library, and its place in the GLB."""

    node: Any
    index: int


def write_nodes(writer: GlbWriter, scene: Any, limits: Limits) -> dict[int, SceneNode]:
    """All nodes but the root, by the number that the library gives them; parents come first."""
    nodes = all_held(scene.nodes)
    limits.check("max_nodes", len(nodes))
    written: dict[int, SceneNode] = {}
    for node in nodes:  # sorted by depth
        if node.is_root:
            continue
        above = written.get(held(node.parent).typed_id)
        place = held(node.local_transform)
        if not np.isfinite([*place.translation, *place.rotation, *place.scale]).all():
            raise InvalidModel("non-finite-data", f"The node {node.name[:80]!r} is not at a finite place.")
        index = writer.node(
            f"{node.parent.name} scale" if node.is_scale_helper else node.name,
            parent=None if above is None else above.index,
            translation=place.translation,
            rotation=place.rotation,
            scale=place.scale,
        )
        written[node.typed_id] = SceneNode(node, index)
    return written
