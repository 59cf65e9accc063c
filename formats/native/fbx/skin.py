"""Skins: clusters of weighted control points, each of a bone."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from caesura.formats.native.fbx.held_objects import all_held, held, matrix, numbers, whole_numbers
from caesura.formats.notices import Notices

LINEAR_METHODS = (0, 1)
"""Of the library's methods of skinning: linear and rigid; the others blend dual quaternions."""


@dataclass(frozen=True)
class Skin:
    """`bones` are nodes by the library's numbers; `bind` takes a vertex into the frame of its bone.

    The joints and weights of a control point are padded with zeros. What no cluster has is moved by the mesh's own
    node, which is the last bone then.
    """

    bones: list[int]
    bind: Float[np.ndarray, "bones 4 4"]
    joints: Int[np.ndarray, "points influences"]
    weights: Float[np.ndarray, "points influences"]


def read_skin(mesh: Any, own_node: Any, notices: Notices) -> Skin | None:
    """The first skin that has weights, for the instance of the mesh at its node."""
    skins = [skin for skin in all_held(mesh.skin_deformers) if len(held(skin.clusters))]
    if not skins:
        return None
    if len(skins) > 1:
        notices.add("skins-left-out", f"{mesh.name!r} has {len(skins)} skins; the first is read.")
    if int(skins[0].skinning_method) not in LINEAR_METHODS:
        notices.add(
            "dual-quaternion-skin",
            f"The skin of {own_node.name!r} blends dual quaternions; it is read as a linear one, which glTF has.",
        )
    clusters = [cluster for cluster in all_held(skins[0].clusters) if _has_bone(cluster)]
    points = [whole_numbers(cluster.vertices) for cluster in clusters]
    weights = [numbers(cluster.weights) for cluster in clusters]
    bones = [held(cluster.bone_node).typed_id for cluster in clusters]
    bind = [matrix(cluster.geometry_to_bone) for cluster in clusters]
    joint = np.repeat(np.arange(len(clusters)), [len(found) for found in points])
    joints, shares = _rows(mesh.num_vertices, joint, np.concatenate([*points, []]), np.concatenate([*weights, []]))
    loose = shares.sum(axis=1) == 0
    if loose.any():
        joints[loose, 0], shares[loose, 0] = len(clusters), 1.0
        bones.append(own_node.typed_id)
        bind.append(matrix(own_node.geometry_to_node))
    return Skin(bones, np.array(bind), joints, shares)


def _has_bone(cluster: Any) -> bool:
    """Whether a node moves it; the root, which is none of the file's nodes, never does."""
    bone = held(cluster.bone_node)
    return bone is not None and not bone.is_root


def _rows(
    count: int, joint: Int[np.ndarray, "pairs"], point: Float[np.ndarray, "pairs"], weight: Float[np.ndarray, "pairs"]
) -> tuple[Int[np.ndarray, "points influences"], Float[np.ndarray, "points influences"]]:
    """Of pairs of a joint and a control point: the joints and weights of each control point, in fours."""
    used = (point >= 0) & (point < count) & (weight > 0) & (weight < np.inf)
    order = np.argsort(point[used], kind="stable")
    joint, at, weight = joint[used][order], point[used][order].astype(np.int64), weight[used][order]
    counts = np.bincount(at, minlength=count)
    place = np.arange(len(at)) - np.repeat(np.cumsum(counts) - counts, counts)
    width = max(-(-int(counts.max(initial=1)) // 4) * 4, 4)
    joints, shares = np.zeros((count, width), np.int64), np.zeros((count, width))
    joints[at, place], shares[at, place] = joint, weight
    total = shares.sum(axis=1, keepdims=True)
    return joints, np.divide(shares, total, out=shares, where=total > 0)
