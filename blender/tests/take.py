"""An armature that performs motions whose frames are known, made in Blender."""

import bpy
import numpy as np

RATE = 30
MOTIONS = ((0.10, 0.5), (0.33, 0.9), (0.21, 0.2))
"""How fast and how far each moves: radians a frame, and radians."""


def make_armature(name, bones):
    """An armature of a chain of bones, active and selected."""
    scene = bpy.context.scene
    armature = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    scene.collection.objects.link(armature)
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    above = None
    for number in range(bones):
        bone = armature.data.edit_bones.new(f"bone {number}")
        bone.head, bone.tail, bone.parent = (0, 0, number * 0.2), (0, 0, number * 0.2 + 0.2), above
        above = bone if number % 5 < 4 else armature.data.edit_bones[0]
    bpy.ops.object.mode_set(mode="OBJECT")
    return armature


def motion_of_frames(frames, segment_frames):
    """Which motion each frame is of: 0, 1, 2, 0, …"""
    return (np.arange(frames) // segment_frames) % len(MOTIONS)


def animate(armature, frames, segment_frames, first=1, every=1):
    """Give it an action with a Bézier key on every so many frames, on each rotation and on the root's place."""
    scene = bpy.context.scene
    scene.render.fps, scene.frame_start, scene.frame_end = RATE, first, first + frames - 1
    action = bpy.data.actions.new("take")
    data = armature.animation_data_create()
    data.action = action
    curves = _curves(action, data, armature.name)
    keyed = np.unique(np.r_[np.arange(0, frames, every), frames - 1])
    motion = motion_of_frames(frames, segment_frames)[keyed]
    speed, reach = (np.array([values[which] for values in MOTIONS])[motion] for which in (0, 1))
    for number in range(len(armature.data.bones)):
        half = reach / 2 * np.sin(keyed * speed + number * (1 + motion))
        rotation = [
            np.cos(half),
            np.sin(half) * (motion == 0),
            np.sin(half) * (motion == 1),
            np.sin(half) * (motion == 2),
        ]
        for index, values in enumerate(rotation):
            _keys(curves.new(f'pose.bones["bone {number}"].rotation_quaternion', index=index), keyed + first, values)
    for index in range(3):
        _keys(
            curves.new('pose.bones["bone 0"].location', index=index), keyed + first, 0.1 * np.sin(keyed * 0.01 + index)
        )
    return action


def _curves(action, data, name):
    if not hasattr(action, "slots"):
        return action.fcurves
    slot = action.slots.new(id_type="OBJECT", name=name)
    data.action_slot = slot
    return action.layers.new("Layer").strips.new(type="KEYFRAME").channelbag(slot, ensure=True).fcurves


def _keys(curve, frames, values):
    curve.keyframe_points.add(len(frames))
    curve.keyframe_points.foreach_set("co", np.stack([frames, values], axis=1).astype(np.float32).reshape(-1))
    curve.keyframe_points.foreach_set("interpolation", np.full(len(frames), 2, np.int32))
    curve.update()
