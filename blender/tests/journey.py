"""What a person does, in a Blender of its own: `python journey.py NAME ZIP ADDRESS`.

The last line is what it saw, as JSON. An ADDRESS that begins with / is the command that starts a local service.
"""

import json
import sys

import bpy
import numpy as np
from installed import finish, install, running
from take import RATE, animate, make_armature

FRAMES, SEGMENT_FRAMES, FIRST = 270, 90, 11


def rig(every=1, bones=6):
    """An armature that performs three motions of 90 frames, from frame 11 on."""
    armature = make_armature("rig", bones)
    animate(armature, FRAMES, SEGMENT_FRAMES, FIRST, every)
    return armature


def find(motions=3):
    """Find that many motions."""
    state = bpy.context.scene.caesura
    state.choose_motions, state.motion_count = False, motions
    bpy.ops.caesura.find()
    finish()


def markers():
    """Names and frames."""
    return sorted(((marker.name, marker.frame) for marker in bpy.context.scene.timeline_markers), key=lambda m: m[1])


def strips(owner):
    """Name, first and last frame, whether it goes round, of each strip."""
    return [
        (strip.name, strip.frame_start, strip.frame_end, strip.action.use_cyclic)
        for track in owner.animation_data.nla_tracks
        if track.name == "Caesura"
        for strip in track.strips
    ]


def poses(armature, frames=range(FIRST, FIRST + FRAMES)):
    """Where every bone is in every frame."""
    scene, found = bpy.context.scene, []
    for frame in frames:
        scene.frame_set(frame)
        found.append([list(map(list, bone.matrix)) for bone in armature.pose.bones])
    return np.array(found)


def deepest(before, after):
    """The largest difference."""
    return float(np.abs(before - after).max())


def things():
    """What could be left over."""
    return sorted(found.name for kind in (bpy.data.scenes, bpy.data.actions, bpy.data.objects) for found in kind)


def found_motions(every=1):
    """Markers, strips, and what has become of the motion and of the scene."""
    armature = rig(every)
    bpy.context.scene.timeline_markers.new("mine", frame=100)
    before = poses(armature)
    bpy.context.scene.frame_set(77)
    names = set(things())
    find()
    frame = bpy.context.scene.frame_current
    made = [action for action in bpy.data.actions if "caesura" in action]
    return {
        "markers": markers(),
        "strips": strips(armature),
        "actions": sorted(action.name for action in made),
        "keys": [len(curve.keyframe_points) for curve in _curves(made[0])][:3],
        "difference": deepest(before, poses(armature)),
        "frame": frame,
        "others": sorted(set(things()) - names - {action.name for action in made}),
        "rate": RATE,
    }


def _curves(action):
    slots = getattr(action, "slots", None)
    return action.layers[0].strips[0].channelbag(slots[0]).fcurves if slots else action.fcurves


def sparse_keys():
    """The same of an action that has a key on every seventh frame only."""
    return found_motions(every=7)


def changed_and_undone():
    """The number of motions changed in place, and taken back in both ways."""
    armature = rig()
    bpy.ops.ed.undo_push(message="before")
    before = poses(armature)
    find()
    first, first_strips = markers(), strips(armature)
    state = bpy.context.scene.caesura
    state.motion_count = 2
    bpy.ops.caesura.change()
    finish()
    second = markers()
    bpy.ops.caesura.undo()
    finish()
    third, third_strips = markers(), strips(armature)
    difference = deepest(before, poses(armature))
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    blenders = markers()
    return {
        "first": first, "second": second, "third": third, "blenders": blenders, "difference": difference,
        "same strips": first_strips == third_strips,
    }  # fmt: skip


def corrected():
    """Markers moved, renamed and deleted, a loop and a discard; then saved."""
    armature = rig()
    before = poses(armature)
    scene = bpy.context.scene
    scene.timeline_markers.new("mine", frame=50)
    find()
    motions = scene.caesura.motions
    motions[0].name = "walk"
    motions[0].loop = True
    motions[2].discard = True
    renamed = markers()
    looped = [action.name for action in bpy.data.actions if action.use_cyclic]
    by_name = {marker.name: marker for marker in scene.timeline_markers}
    by_name["B"].frame = FIRST + 80
    by_name["B"].name = "turn"
    bpy.ops.caesura.save()
    finish()
    saved = {"markers": markers(), "strips": strips(armature), "revision": json.loads(scene.caesura.revisions_json)}
    within = range(FIRST, FIRST + 2 * SEGMENT_FRAMES - 10)
    kept = deepest(before[: len(within)], poses(armature, within))
    scene.timeline_markers.remove(next(marker for marker in scene.timeline_markers if marker.name == "turn"))
    bpy.ops.caesura.save()
    finish()
    return {
        **saved, "renamed": renamed, "looped": looped, "difference": kept, "merged": markers(),
        "segmentation": scene.caesura.result["segmentation"],
        "discards": [motion.discard for motion in scene.caesura.motions],
    }  # fmt: skip


def removed():
    """All of it taken away again, after two results."""
    armature = rig()
    take, before, names = armature.animation_data.action.name, poses(armature), things()
    find()
    find(2)
    bpy.ops.caesura.remove()
    finish()
    return {
        "same things": names == things(), "action": armature.animation_data.action.name == take,
        "markers": markers(), "difference": deepest(before, poses(armature)),
        "tracks": len(armature.animation_data.nla_tracks),
    }  # fmt: skip


def of_a_mesh():
    """A mesh that an armature deforms: its vertices are sent, and the armature's action is cut."""
    armature = rig()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8)
    mesh = bpy.context.object
    mesh.modifiers.new("rig", "ARMATURE").object = armature
    for number, bone in enumerate(armature.data.bones):
        mesh.vertex_groups.new(name=bone.name).add(range(number, len(mesh.data.vertices), 6), 1.0, "REPLACE")
    bpy.context.scene.caesura.frame_range = "SCENE"
    find()
    return {"markers": markers(), "strips": strips(armature)}


def of_shape_keys():
    """A mesh with shape keys: their action is cut."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8)
    mesh = bpy.context.object
    mesh.shape_key_add(name="Basis")
    for axis in range(3):
        shape = mesh.shape_key_add(name=f"shape {axis}")
        for point in shape.data:
            point.co[axis] *= 2
        speed = (0.4, 0.9, 0.2)[axis]
        for frame in range(FRAMES):
            shape.value = abs(np.sin(frame * speed)) if frame // SEGMENT_FRAMES == axis else 0
            shape.keyframe_insert("value", frame=FIRST + frame)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.caesura.frame_range = FIRST, FIRST + FRAMES - 1, "SCENE"

    def values():
        found = []
        for frame in range(FIRST, FIRST + FRAMES):
            scene.frame_set(frame)
            found.append([shape.value for shape in mesh.data.shape_keys.key_blocks])
        return np.array(found)

    before = values()
    find()
    return {"markers": markers(), "strips": strips(mesh.data.shape_keys), "difference": deepest(before, values())}


def cancelled():
    """Cancelled while frames are read, and while actions are cut: nothing is left."""
    rig()
    names, seen = things(), []
    running().BUDGET_SECONDS = 0.001  # many slices, of which one is the last
    for stage in ("reading frames", "cutting actions"):
        bpy.ops.caesura.find()
        while running().RUNNING.stage != stage and running().tick() is not None:
            pass
        seen.append(running().RUNNING.stage)
        bpy.ops.caesura.cancel()
    return {"same things": names == things(), "stages": seen, "markers": markers()}


def without_a_service():
    """What the panel says where nobody answers; nothing has changed."""
    rig()
    names = things()
    bpy.ops.caesura.find()
    try:
        finish()
    except RuntimeError as said:
        return {"said": str(said), "same things": names == things(), "markers": markers()}
    return {}


def away_without_online_access():
    """The same where the service is elsewhere and Blender's user allows no network."""
    preferences = bpy.context.preferences.addons["bl_ext.user_default.caesura"].preferences
    preferences.address = "https://caesura.invalid"
    return without_a_service()


def local_service():
    """With a service that the add-on starts and ends."""
    rig()
    find()
    process = sys.modules["bl_ext.user_default.caesura.motions"].LOCAL._process
    ran = process.poll() is None
    bpy.ops.preferences.addon_disable(module="bl_ext.user_default.caesura")
    return {"markers": markers(), "ran": ran, "ended": process.poll() is not None}


if __name__ == "__main__":
    name, zip_path, place = sys.argv[1:4]
    install(zip_path, **({"command": place} if place.startswith("/") else {"address": place}))
    print(json.dumps(globals()[name]()))
