"""A glTF in, an animation out: each step of reading in order."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from core.animation import Animation, Take
from core.errors import InvalidModel
from core.formats.frame_rate import ASSUMED, frame_count, key_rate
from core.formats.gltf.accessors import Accessors
from core.formats.gltf.channels import Channel
from core.formats.gltf.document import Document
from core.formats.gltf.figure import Figure, joints_figure, read_figure, still_weights
from core.formats.gltf.key_times import MOST_KEYS
from core.formats.gltf.nodes import NodeGraph, read_nodes, scene_nodes
from core.formats.gltf.posing.skeleton import read_skeleton
from core.formats.gltf.posing.vertices import PosedVertices, rest_pose
from core.formats.gltf.sampling import Slots, Tracks, read_tracks
from core.formats.gltf.take import choose_animation
from core.limits import Limits
from core.parameters import Parameters


def read_gltf(data: memoryview, parts: Mapping[str, memoryview], parameters: Parameters, limits: Limits) -> Animation:
    """The animation of a glTF or GLB; `parts` are files sent beside it, found by their exact names."""
    document = Document(data, parts, limits)
    accessors = Accessors(document)
    graph = read_nodes(document)
    nodes = scene_nodes(document, graph)
    index, name, channels = choose_animation(document, accessors, parameters.take)
    figure = read_figure(document, accessors, graph, nodes) or _skeleton_figure(document, graph, nodes, channels)
    skeleton, still, slots = read_skeleton(graph, figure)
    still, weight_slots = _with_weights(document, graph, figure, still)
    tracks = read_tracks(accessors, channels, still, slots, weight_slots)
    rate = _rate(document, parameters, tracks)
    frames = _frames(limits, tracks.duration, rate, len(figure.triangles))
    return Animation(
        vertices=PosedVertices(figure, skeleton, tracks, weight_slots, rate),
        vertex_count=len(figure.positions),
        triangles=figure.triangles,
        rest=rest_pose(figure, skeleton, still),
        frames=frames,
        frame_rate=rate,
        take=Take(index, name, tracks.duration, frames, rate),
        notices=document.notices.told(),
    )


def _skeleton_figure(document: Document, graph: NodeGraph, nodes: list[int], channels: list[Channel]) -> Figure:
    """The joints that move, where there is no mesh: nodes that are animated, and all below them."""
    moving = {channel.node for channel in channels}
    joints = []
    for node in nodes:  # parents come first
        if node in moving or graph.parent[node] in moving:
            moving.add(node)
            joints.append(node)
    if not joints:
        raise InvalidModel("no-mesh", "The scene has no mesh, and none of its nodes is animated.")
    document.limits.check("max_vertices", len(joints))
    document.notices.add("skeleton-only", f"The file has no mesh; its {len(joints)} joints were taken.")
    return joints_figure(np.array(joints, np.int64))


def _with_weights(
    document: Document, graph: NodeGraph, figure: Figure, still: Float[np.ndarray, "numbers"]
) -> tuple[Float[np.ndarray, "more"], Slots]:
    """The still pose with morph weights after it, and where those of each node begin."""
    slots: Slots = {}
    rows = [still]
    length = len(still)
    for node in {part.node: None for part in figure.parts if part.targets is not None}:
        weights = still_weights(document, graph.entries[node])
        slots[node], length = length, length + len(weights)
        rows.append(np.array(weights))
    return np.concatenate(rows), slots


def _rate(document: Document, parameters: Parameters, tracks: Tracks) -> float:
    if parameters.fps != "source":
        return float(parameters.fps)
    rate = key_rate(tracks.densest[:MOST_KEYS].tolist())
    if rate is None:
        document.notices.add("frame-rate-assumed", f"The keys tell no frame rate; {ASSUMED:g} a second was taken.")
    return rate or ASSUMED


def _frames(limits: Limits, duration: float, rate: float, triangles: int) -> int:
    """Frames of the take, compared with the limits while they are still a float."""
    limits.check("max_seconds", duration, "Cut the take")
    frames = frame_count(duration, rate)
    limits.check("max_frames", frames, "Send a lower fps or cut the take")
    limits.check("max_triangle_frames", frames * triangles, "Send a lower fps, cut the take or decimate the mesh")
    return int(frames)
