"""Skins: joints, and where each stood when the mesh was bound to them."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.geometry.accessors import Accessors

IDENTITY = np.eye(4)[:3].reshape(-1)


@dataclass(frozen=True)
class Skin:
    """`joints` are nodes; `bind` takes the mesh into each joint's own frame (row by row, 3 x 4)."""

    joints: Int[np.ndarray, "J"]
    bind: Float[np.ndarray, "J 12"]


def read_skin(document: GltfDocument, accessors: Accessors, number: int) -> Skin:
    """One skin of the file; raises `invalid-skin`."""
    entry = document.skins[number]
    joints = entry.values("joints")
    for place, joint in enumerate(joints):
        if type(joint) is not int or not 0 <= joint < len(document.nodes):
            raise entry.refusal("A joint must be a node.", "invalid-skin", f"joints/{place}")
    if not joints:
        raise entry.refusal("The skin has no joints.", "invalid-skin", "joints")
    bind = np.tile(IDENTITY, (len(joints), 1))
    if "inverseBindMatrices" in entry:
        layout = accessors.layout(entry.index("inverseBindMatrices", len(accessors), "accessors", "invalid-skin"))
        if layout.type != "MAT4" or layout.dtype.kind != "f" or layout.count < len(joints):
            raise entry.refusal(
                f"{len(joints)} joints need as many float matrices, not {layout.count} of {layout.type}.",
                "invalid-skin",
                "inverseBindMatrices",
            )
        matrices = accessors.floats(layout)[: len(joints)].reshape(-1, 4, 4).transpose(0, 2, 1)
        bind = matrices[:, :3].reshape(-1, 12).astype(np.float64)
        if (np.abs(np.linalg.det(matrices[:, :3, :3].astype(np.float64))) == 0).any():
            document.notices.add("singular-bind", f"{entry.pointer} has an inverse bind matrix without an inverse.")
    return Skin(np.array(joints, np.int64), bind)
