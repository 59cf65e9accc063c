"""Animation stacks as takes: every frame at the file's rate, as the library evaluates it.

A stack may have layers, and curves of any kind of tangent on any angle of a rotation: keys on every frame hold what
comes out of them. What stays the same is left out.
"""

from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import ufbx
from jaxtyping import Float

from caesura.core.limits import Limits
from caesura.formats.decode_budget import DecodeBudget
from caesura.formats.gltf.writer import Channel, GlbWriter, Path
from caesura.formats.native.fbx.blend_shapes import BlendShapes
from caesura.formats.native.fbx.held_objects import all_held, held
from caesura.formats.native.fbx.nodes import SceneNode
from caesura.formats.notices import Notices
from caesura.formats.takes.frame_rate import ASSUMED, count_frames
from caesura.formats.takes.take_selection import take_name

FASTEST = 1000.0
LONGEST = 7 * 24 * 3600.0
"""Seconds of a stack; what claims more claims all of time, and ends with its keys."""

STILL = 1e-7
"""Share of a value by which it may change and stay the same: float32 knows no more."""

PLACES: tuple[tuple[Path, slice], ...] = (
    ("translation", slice(0, 3)),
    ("rotation", slice(3, 7)),
    ("scale", slice(7, 10)),
)


@dataclass(frozen=True)
class MorphedNode:
    """A node of the GLB that has a mesh with blend shapes."""

    index: int
    shapes: BlendShapes


@dataclass(frozen=True)
class TakeTimes:
    """`frames` from `begin` on, in seconds of the file's clock."""

    begin: float
    frames: int
    rate: float

    def seconds(self) -> list[float]:
        """Of each frame on the file's clock."""
        return [self.begin + frame / self.rate for frame in range(self.frames)]


def write_takes(
    writer: GlbWriter,
    scene: Any,
    nodes: dict[int, SceneNode],
    morphed: list[MorphedNode],
    limits: Limits,
    notices: Notices,
) -> bool:
    """All stacks, in order, and whether one moves anything; raises `LimitExceeded` before anything is sampled."""
    stacks = all_held(scene.anim_stacks)
    limits.check("max_takes", len(stacks))
    rate = _rate(scene, notices)
    moving = [_moving_nodes(stack, nodes) for stack in stacks]
    times = [_times(stack, rate) for stack in stacks]
    budget = DecodeBudget(limits)
    for found, time in zip(moving, times, strict=True):
        limits.check("max_seconds", time.frames / rate, "Cut the take")
        limits.check("max_frames", time.frames, "Cut the take")
        limits.check("max_node_frames", time.frames * len(found), "Cut the take")
        budget.spend(time.frames * 4 * (10 * len(found) + sum(len(node.shapes.offsets) for node in morphed)))
    moves = False
    for place, (stack, found, time) in enumerate(zip(stacks, moving, times, strict=True)):
        name = take_name(stack.name, place)
        if abs(time.begin * rate) >= 0.5:
            notices.add(
                "take-start",
                f"Take {name!r} begins at {time.begin:.3f} s of the file's clock, frame {time.begin * rate:g}; frames "
                "are counted from there.",
            )
        channels = list(_channels(held(stack.anim), found, morphed, time))
        writer.animation(name, channels)
        moves |= bool(channels)
    return moves


def _rate(scene: Any, notices: Notices) -> float:
    rate = float(held(scene.settings).frames_per_second)
    if 0 < rate <= FASTEST:
        return rate
    notices.add("frame-rate-assumed", f"The file has no frame rate; {ASSUMED:g} frames a second are assumed.")
    return ASSUMED


def _moving_nodes(stack: Any, nodes: dict[int, SceneNode]) -> list[SceneNode]:
    """The nodes that a layer of the stack has curves for, and those that a scale above them moves.

    Where a node does not inherit scale as usual, a helper has the scale of its parent, with the curves of that; what
    the node does inherit is in its own place, or in the scale of a helper below it.
    """
    curved = {
        held(moved.element).element_id for layer in all_held(stack.layers) for moved in all_held(layer.anim_props)
    }
    found: dict[int, SceneNode] = {}
    for number, known in nodes.items():  # parents come first
        node, above = known.node, held(known.node.parent)
        inherits = node.is_scale_helper or node.original_inherit_mode != ufbx.InheritMode.NORMAL
        helper = held(above.scale_helper)
        scaled = above.typed_id in found or (helper is not None and helper.element_id in curved)
        if node.element_id in curved or (inherits and scaled):
            found[number] = known
    return list(found.values())


def _times(stack: Any, rate: float) -> TakeTimes:
    begin, end = float(stack.time_begin), float(stack.time_end)
    if not 0 < end - begin <= LONGEST:
        begin, end = _key_range(stack)
    return TakeTimes(begin, int(count_frames(end - begin, rate)), rate)


def _key_range(stack: Any) -> tuple[float, float]:
    """From the first key of the stack to its last one."""
    curves = [
        held(curve)
        for layer in all_held(stack.layers)
        for value in all_held(layer.anim_values)
        for curve in value.curves
        if curve is not None and len(held(curve.keyframes))
    ]
    begin = min((float(curve.min_time) for curve in curves), default=0.0)
    end = max((float(curve.max_time) for curve in curves), default=0.0)
    return (begin, end) if 0 <= end - begin <= LONGEST else (0.0, 0.0)


def _channels(anim: Any, moving: list[SceneNode], morphed: list[MorphedNode], time: TakeTimes) -> Iterator[Channel]:
    seconds = time.seconds()
    keys = (np.arange(time.frames) / time.rate).astype(np.float32)
    for known in moving:
        values = _sampled_places(anim, known.node, seconds)
        rest = held(known.node.local_transform)
        still = np.array([*rest.translation, *rest.rotation, *rest.scale])
        for path, columns in PLACES:
            yield from _channel(known.index, path, keys, values[:, columns], still[columns])
    for node in morphed:
        shares = [
            one.shares(np.array([one.channel.evaluate_blend_weight(anim, second) for second in seconds]))
            for one in node.shapes.channels
        ]
        if shares:
            yield from _channel(
                node.index, "weights", keys, np.concatenate(shares, axis=1), np.array(node.shapes.rest_shares())
            )


def _channel(
    node: int,
    path: Path,
    keys: Float[np.ndarray, "frames"],
    values: Float[np.ndarray, "frames numbers"],
    still: Float[np.ndarray, "numbers"],
) -> Iterator[Channel]:
    """The values as a channel: one key where they never change, none where that is the node's own value."""
    size = STILL * np.abs(values).max(initial=1e-30)
    if (np.abs(values - values[0]) <= size).all():
        if (np.abs(values[0] - still) <= size).all():
            return
        keys, values = keys[:1], values[:1]
    flat = values.astype(np.float32)
    yield Channel(node, path, keys, flat.reshape(-1) if path == "weights" else flat)


def _sampled_places(anim: Any, node: Any, seconds: list[float]) -> Float[np.ndarray, "frames 10"]:
    """Translation, rotation and scale at each time; a rotation and its negative are the same, and stay on one side."""
    found = array("d")
    evaluate = node.evaluate_transform
    for second in seconds:
        place = evaluate(anim, second)
        found.extend(place.translation)
        found.extend(place.rotation)
        found.extend(place.scale)
    values = np.array(found).reshape(-1, 10)
    turned = np.einsum("fi,fi->f", values[1:, 3:7], values[:-1, 3:7]) < 0
    values[1:, 3:7] *= np.where(np.cumsum(turned) % 2, -1.0, 1.0)[:, None]
    return values
