"""Meshes drawn many times by one node (EXT_mesh_gpu_instancing)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.posing.node_graph import unit_rotations
from caesura.formats.gltf.posing.skins import IDENTITY
from caesura.formats.kernels.posing import compute_world_matrices

EXTENSION = "EXT_mesh_gpu_instancing"
KINDS = {"TRANSLATION": "VEC3", "ROTATION": "VEC4", "SCALE": "VEC3"}


@dataclass(frozen=True)
class MeshInstances:
    """How often a node draws its mesh, and the accessors that say where; once where it says nothing of it."""

    count: int = 1
    layouts: dict[str, AccessorLayout] | None = None

    def places(self, accessors: Accessors) -> Float[np.ndarray, "count 12"]:
        """From the mesh into the node's own space: translation · rotation · scale, row by row 3 x 4."""
        if self.layouts is None:
            return IDENTITY[None]
        pose = np.zeros((1, 10 * self.count))
        rows = pose.reshape(self.count, 10)
        rows[:, 6:] = 1
        for name, part in (("TRANSLATION", slice(0, 3)), ("ROTATION", slice(3, 7)), ("SCALE", slice(7, 10))):
            if name in self.layouts:
                values = accessors.floats(self.layouts[name])
                if name == "ROTATION" and not values.any(axis=1).all():
                    raise self.layouts[name].entry.refusal("A rotation is zero, which is no rotation.")
                rows[:, part] = unit_rotations(values, rounded=True) if name == "ROTATION" else values
        matrices = np.empty((1, self.count, 12))
        none = np.zeros(self.count, bool)
        compute_world_matrices(pose, np.full(self.count, -1), np.zeros((self.count, 12)), none, matrices)
        found: Float[np.ndarray, "count 12"] = matrices[0]
        return found


def read_instances(document: GltfDocument, accessors: Accessors, node: JsonObject) -> MeshInstances:
    """The instances of a node, counted and not yet read; raises `invalid-gltf`."""
    entry = node.extension(EXTENSION)
    if entry is None:
        return MeshInstances()
    if "skin" in node:
        document.notices.add("instances-ignored", f"{node.pointer} has a skin; its instances were left out.")
        return MeshInstances()
    attributes = entry.entry("attributes")
    layouts = {
        name: accessors.layout(attributes.index(name, len(accessors), "accessors"))
        for name in KINDS
        if attributes is not None and name in attributes
    }
    counts = {layout.count for layout in layouts.values()}
    if len(counts) != 1:
        raise entry.refusal("The instances need translations, rotations or scales, as many of each.", name="attributes")
    for name, layout in layouts.items():
        if layout.type != KINDS[name] or (name != "ROTATION" and layout.dtype.kind != "f"):
            raise entry.refusal(f"{name} cannot be {layout.type} of {layout.dtype}.", name="attributes")
        accessors.check(layout, vertex_data=False)
    document.notices.add(
        "instances-expanded", f"{node.pointer} draws its mesh {max(counts)} times; every instance was taken."
    )
    return MeshInstances(counts.pop(), layouts)
