"""A glTF in, an animation out: each step of reading in order."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from caesura.core.animation import Animation
from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.gltf.animation.channels import Channel
from caesura.formats.gltf.animation.glb_key_times import MOST_KEYS
from caesura.formats.gltf.animation.sampled_take import SceneSize, join_all_takes, sample_one_take
from caesura.formats.gltf.animation.sampling import KeyTracks, PoseSlots, read_tracks
from caesura.formats.gltf.animation.take_choice import find_chosen_takes
from caesura.formats.gltf.geometry.accessors import Accessors
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.gltf.posing.joints_of_mesh import find_joints
from caesura.formats.gltf.posing.node_graph import NodeGraph, read_nodes, scene_nodes
from caesura.formats.gltf.posing.posed_vertices import PosedVertices, sample_rest_pose
from caesura.formats.gltf.posing.skeleton import read_skeleton
from caesura.formats.gltf.scene_mesh import SceneMesh, default_morph_weights, joints_as_scene_mesh, read_scene_mesh
from caesura.formats.gltf.skeleton_joints import find_moving_joints
from caesura.formats.takes.frame_rate import ASSUMED, estimate_key_rate


def read_gltf(data: memoryview, parts: Mapping[str, memoryview], parameters: Parameters, limits: Limits) -> Animation:
    """The animation of a glTF or GLB; `parts` are files sent beside it, found by their exact names."""
    document = GltfDocument(data, parts, limits)
    accessors = Accessors(document)
    _ = document.skins  # a list of objects, used or not
    graph = read_nodes(document)
    nodes = scene_nodes(document, graph)
    chosen = find_chosen_takes(document, accessors, parameters.take)
    channels = [channel for take in chosen for channel in take.channels]
    figure = read_scene_mesh(document, accessors, graph, nodes) or _joints_as_figure(document, graph, nodes, channels)
    skeleton, still, slots = read_skeleton(graph, figure)
    still, weight_slots = _append_morph_weights(document, graph, figure, still)
    tracks = [read_tracks(accessors, take.channels, still, slots, weight_slots) for take in chosen]
    rate = _rate(document, parameters, max(tracks, key=lambda take: take.duration))

    def pose(take: KeyTracks, start: float) -> PosedVertices:
        return PosedVertices(figure, skeleton, take, weight_slots, rate, start)

    size = SceneSize(len(figure.triangles), len(skeleton.parent) + len(skeleton.bone_node))
    if len(chosen) == 1:
        course = sample_one_take(chosen[0], tracks[0], pose, rate, size, parameters, limits)
    else:
        course = join_all_takes(chosen, tracks, pose, rate, size, parameters, limits, document.notices)
    return Animation(
        vertices=course.vertices,
        vertex_count=len(figure.positions),
        triangles=figure.triangles,
        rest=sample_rest_pose(figure, skeleton, still),
        frames=course.frames,
        frame_rate=rate,
        take=course.take,
        start_seconds=course.start_seconds,
        gltf={**parts, "": data} if len(chosen) == 1 and not figure.instanced else None,
        notices=document.notices.in_order(),
        joints=find_joints(figure, graph, course.vertices),
    )


def _joints_as_figure(document: GltfDocument, graph: NodeGraph, nodes: list[int], channels: list[Channel]) -> SceneMesh:
    """The joints that move, where there is no mesh."""
    joints = find_moving_joints(document, nodes, graph.parent.tolist(), channels)
    if not joints:
        raise InvalidModel("no-mesh", "The scene has no mesh, and none of its nodes is animated.", pointer="/nodes")
    document.limits.check("max_vertices", len(joints), pointer="/nodes")
    document.notices.add("skeleton-only", f"The file has no mesh; its {len(joints)} joints were taken.")
    return joints_as_scene_mesh(np.array(joints, np.int64))


def _append_morph_weights(
    document: GltfDocument, graph: NodeGraph, figure: SceneMesh, still: Float[np.ndarray, "numbers"]
) -> tuple[Float[np.ndarray, "more"], PoseSlots]:
    """The still pose with morph weights after it, and where those of each node begin."""
    slots: PoseSlots = {}
    rows = [still]
    length = len(still)
    for node in {part.node: None for part in figure.parts if part.targets is not None}:
        weights = default_morph_weights(document, graph.entries[node])
        slots[node], length = length, length + len(weights)
        rows.append(np.array(weights))
    return np.concatenate(rows), slots


def _rate(document: GltfDocument, parameters: Parameters, tracks: KeyTracks) -> float:
    if parameters.fps != "source":
        return float(parameters.fps)
    rate = estimate_key_rate(tracks.densest[:MOST_KEYS].tolist())
    if rate is None:
        document.notices.add(
            "frame-rate-assumed", f"The keys have no frame rate; {ASSUMED:g} frames a second are assumed."
        )
    return rate or ASSUMED
