"""The segments as named actions, on a track of strips where the take was.

Since Blender 4.4 an action has slots, and its curves lie in the channel bag of one; before, it has curves.
"""

from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np

from .key_cut import Keys, baked_keys, cut_keys
from .segments import Segment, clip_names
from .sliced_work import Steps

TRACK = "Caesura"
NEW_TRACK = "Caesura, being made"
TAKE_TRACK = "Caesura take"
"""Holds the take in a muted strip: what is on no track leaves Blender's evaluation, and coming back takes it long."""

MARK = "caesura"
"""The property of an action that was made here."""

LOOP = "-loop"
NUMBERS = ("interpolation", "handle_left_type", "handle_right_type")


def animated_of(target: Any) -> Iterator[tuple[Any, bool]]:
    """The object and what deforms it, each as its owner and whether its shape keys are meant."""
    yield target, False
    if target.type == "MESH":
        if target.data.shape_keys is not None:
            yield target, True
        rigs = {modifier.object for modifier in target.modifiers if modifier.type == "ARMATURE"} | {target.parent}
        yield from ((rig, False) for rig in rigs if rig is not None and rig.type == "ARMATURE")


def note_takes(state: Any, target: Any) -> None:
    """Keep which actions the take is made of; those that have been cut already stay what they were."""
    known = {(take.owner, take.of_shape_keys) for take in state.takes if take.owner is not None and take.action}
    for owner, of_shape_keys in animated_of(target):
        data = (owner.data.shape_keys if of_shape_keys else owner).animation_data
        if data is None or data.action is None or data.action.library is not None:
            continue
        if (owner, of_shape_keys) in known:
            for at in range(len(state.takes) - 1, -1, -1):
                if (state.takes[at].owner, state.takes[at].of_shape_keys) == (owner, of_shape_keys):
                    state.takes.remove(at)
        take = state.takes.add()
        take.owner, take.of_shape_keys, take.action = owner, of_shape_keys, data.action
        slot = getattr(data, "action_slot", None)
        take.slot = slot.identifier if slot else ""


def curves_of(action: Any, slot: str) -> list[Any]:
    """The F-curves of an action, in one of its slots where it has them."""
    if not getattr(action, "slots", None):
        return list(action.fcurves) if hasattr(action, "fcurves") else []
    found = action.slots.get(slot) or action.slots[0]
    bags = [strip.channelbag(found) for layer in action.layers for strip in layer.strips]
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def make_actions(state: Any, segments: list[Segment], report: Any) -> Steps:
    """An action for each segment and each action of the take: answers them by place of the take and of the segment."""
    made: dict[tuple[int, int], Any] = {}
    names = clip_names(segments)
    try:
        for at, take in enumerate(state.takes):
            curves = curves_of(take.action, take.slot)
            rooms = []
            for number, (segment, name) in enumerate(zip(segments, names, strict=True)):
                if segment.discard:
                    continue
                called = f"{name}{LOOP if segment.loop else ''}" + (" shapes" if take.of_shape_keys else "")
                action, room, slot = _new_action(called, take)
                made[at, number] = (action, slot)
                rooms.append((_mark(action, called, state, segment), segment, room))
                yield
            for done, curve in enumerate(curves):
                report("cutting actions", (at + done / len(curves)) / len(state.takes))
                keys = yield from read_keys(curve)
                for length, segment, room in rooms:
                    _copy_part(curve, keys, room, state.first_frame + segment.start, length)
                    yield
    except BaseException:
        for action, _ in made.values():
            bpy.data.actions.remove(action)
        raise
    return made


def _mark(action: Any, name: str, state: Any, segment: Segment) -> int:
    """Say of a new action what it is of; its length in frames: up to the pose that the next one begins with."""
    length = max(min(segment.end, state.frame_count - 1) - segment.start, 1)
    action[MARK] = {"name": name, "motion": segment.name, "start": segment.start, "end": segment.end}
    action.use_fake_user = True
    action.use_frame_range = True
    action.frame_start, action.frame_end = 0, length
    action.use_cyclic = segment.loop
    return length


def _new_action(name: str, take: Any) -> tuple[Any, Any, Any]:
    """An action without curves, what holds its curves, and its slot."""
    action = bpy.data.actions.new(name)
    kind = "KEY" if take.of_shape_keys else "OBJECT"
    if not hasattr(action, "slots"):
        action.id_root = kind
        return action, action.fcurves, None
    slot = action.slots.new(id_type=kind, name=take.animated.name)
    strip = action.layers.new("Layer").strips.new(type="KEYFRAME")
    return action, strip.channelbag(slot, ensure=True).fcurves, slot


def read_keys(curve: Any) -> Steps:
    """The keys of a curve; None where they are not all that makes it."""
    points, count = curve.keyframe_points, len(curve.keyframe_points)
    if not count or len(curve.modifiers) or curve.extrapolation != "CONSTANT":
        return None
    found = []
    for name in ("co", "handle_left", "handle_right"):
        places = np.empty(2 * count, np.float32)
        points.foreach_get(name, places)
        found.append(places.reshape(-1, 2).astype(np.float64))
        yield
    for name in NUMBERS:
        numbers = np.empty(count, np.int32)
        points.foreach_get(name, numbers)
        found.append(numbers)
        yield
    return Keys(*found)


def _copy_part(curve: Any, keys: Keys | None, room: Any, start: int, length: int) -> None:
    part = cut_keys(keys, start, start + length) if keys is not None else None
    if part is None:
        part = baked_keys([curve.evaluate(frame) for frame in range(start, start + length + 1)])
    write_keys(_new_curve(room, curve), part)


def _new_curve(room: Any, like: Any) -> Any:
    group = like.group.name if like.group else ""
    known = room.bl_rna.functions["new"].parameters.keys()
    named = {name: group for name in ("action_group", "group_name") if name in known and group}
    return room.new(like.data_path, index=like.array_index, **named)


def write_keys(curve: Any, keys: Keys) -> None:
    """Give a new curve its keys."""
    points = curve.keyframe_points
    points.add(len(keys))
    for name, places in (("co", keys.co), ("handle_left", keys.left), ("handle_right", keys.right)):
        points.foreach_set(name, places.astype(np.float32).reshape(-1))
    for name, numbers in zip(NUMBERS, (keys.interpolation, keys.left_type, keys.right_type), strict=True):
        points.foreach_set(name, np.ascontiguousarray(numbers, np.int32))
    curve.update()


def push_strips(state: Any, segments: list[Segment], made: dict[tuple[int, int], Any]) -> Steps:
    """Put the new actions in place of the take and of the strips that were there; answers the actions these had.

    Blender copies each action that comes onto a track, so one comes at a time.
    """
    old = own_actions(state)
    try:
        for at, take in enumerate(state.takes):
            track = take.animated.animation_data_create().nla_tracks.new()
            track.name = NEW_TRACK
            for number, segment in enumerate(segments):
                if (at, number) in made:
                    _add_strip(track, state.first_frame + segment.start, *made[at, number])
                    bpy.context.view_layer.update()
                    yield
    except BaseException:
        for take in state.takes:
            _remove_tracks(take.animated.animation_data, {NEW_TRACK})
        for action, _ in made.values():
            bpy.data.actions.remove(action)
        raise
    for take in state.takes:
        data = take.animated.animation_data
        _remove_tracks(data, {TRACK, TAKE_TRACK})
        data.nla_tracks[NEW_TRACK].name = TRACK
        _park(take, data)
        data.action = None
        bpy.context.view_layer.update()
        yield
    return old


def _park(take: Any, data: Any) -> None:
    """Keep the take on a muted strip."""
    take.action.use_fake_user = True
    track = data.nla_tracks.new()
    track.name = TAKE_TRACK
    strip = track.strips.new(take.action.name, int(take.action.frame_range[0]), take.action)
    if take.slot and hasattr(strip, "action_slot"):
        strip.action_slot = take.action.slots.get(take.slot)
    strip.mute = True


def _add_strip(track: Any, start: int, action: Any, slot: Any) -> None:
    strip = track.strips.new(action.name, start, action)
    if slot is not None:
        strip.action_slot = slot
    strip.name = action.name
    strip.extrapolation = "HOLD" if len(track.strips) == 1 else "HOLD_FORWARD"


def own_actions(state: Any) -> list[Any]:
    """The actions of the strips that were made here."""
    found = {
        strip.action
        for take in state.takes
        if take.owner is not None and take.animated is not None and take.animated.animation_data is not None
        for track in take.animated.animation_data.nla_tracks
        if track.name == TRACK
        for strip in track.strips
        if strip.action is not None and MARK in strip.action
    }
    return sorted(found, key=lambda action: action.name)


def restore_takes(state: Any) -> list[Any]:
    """Put the take back in place of the strips; answers the actions that these had."""
    old = own_actions(state)
    for take in state.takes:
        if take.owner is None or take.action is None:
            continue
        data = take.animated.animation_data_create()
        data.action = take.action
        if take.slot and hasattr(data, "action_slot"):
            data.action_slot = take.action.slots.get(take.slot)
        _remove_tracks(data, {TRACK, TAKE_TRACK})
    state.takes.clear()
    return old


def remove_actions(actions: list[Any]) -> Steps:
    """Delete actions that nothing needs any more, one a step."""
    for action in actions:
        bpy.data.actions.remove(action)
        bpy.context.view_layer.update()
        yield


def name_actions(state: Any) -> None:
    """Call actions and strips as they are to be, once those of the same name are gone."""
    for take in state.takes:
        for track in take.animated.animation_data.nla_tracks:
            for strip in track.strips if track.name == TRACK else ():
                if strip.action is not None:
                    strip.action.name = strip.action[MARK]["name"]
                    strip.name = strip.action.name


def rename_actions(state: Any, old: str, new: str) -> None:
    """Call the actions of a motion as it is called now."""
    for action in own_actions(state):
        if action[MARK]["motion"] == old:
            action[MARK]["motion"] = new
            action.name = new + action.name.removeprefix(old)


def flag_loops(state: Any, motion: str, loop: bool) -> None:
    """Mark the actions of a motion as cycles, or take the mark away."""
    for action in own_actions(state):
        if action[MARK]["motion"] == motion and action.use_cyclic != loop:
            action.use_cyclic = loop
            action.name = action.name + LOOP if loop else action.name.replace(LOOP, "")


def key_count(state: Any, target: Any) -> int:
    """How many keys the take of an object has."""
    actions = {take.action: take.slot for take in state.takes if take.action is not None}
    for owner, of_shape_keys in animated_of(target):
        data = (owner.data.shape_keys if of_shape_keys else owner).animation_data
        if data is not None and data.action is not None:
            slot = getattr(data, "action_slot", None)
            actions[data.action] = slot.identifier if slot else ""
    return sum(len(curve.keyframe_points) for action, slot in actions.items() for curve in curves_of(action, slot))


def _remove_tracks(data: Any, names: set[str]) -> None:
    for track in [track for track in data.nla_tracks if track.name in names]:
        data.nla_tracks.remove(track)
