"""How long Blender's main thread is held at once: `python responsiveness.py ZIP ADDRESS [FRAMES]`, with the module bpy.

An armature of 25 bones and 103 curves, a key on every frame: it is sent, cut into named actions, cut into another
number of motions, taken back and removed. Each line has the seconds it took, and the longest step of the main thread:
by the clock, and of the processor, which says what it is where other programs do not take the processor away.
"""

import sys
import time

import bpy
from installed import finish, install
from take import animate, make_armature

SEGMENT_FRAMES = 900


def main(zip_path, address, frames):
    """Print a line for each step."""
    install(zip_path, address)
    armature = make_armature("rig", 25)
    animate(armature, frames, SEGMENT_FRAMES)
    bpy.context.view_layer.update()  # as it is once a file has been opened: Blender has its own copy of the keys
    state = bpy.context.scene.caesura
    state.choose_motions, state.motion_count = False, 3
    steps = []
    for name, begin in (
        ("find", bpy.ops.caesura.find),
        ("another number", lambda: setattr(state, "motion_count", 4) or bpy.ops.caesura.change()),
        ("undo", bpy.ops.caesura.undo),
        ("save", bpy.ops.caesura.save),
        ("remove", bpy.ops.caesura.remove),
    ):
        begun, computed = time.perf_counter(), time.thread_time()
        begin()
        operator = (time.perf_counter() - begun, time.thread_time() - computed)
        step = tuple(map(max, finish(900), operator))
        steps.append(step)
        seconds, count = time.perf_counter() - begun, len(bpy.context.scene.timeline_markers)
        print(f"{name:<15}{seconds:7.1f} s, longest step {_milliseconds(step)}, {count} markers", flush=True)
    longest = _milliseconds(map(max, zip(*steps, strict=True)))
    print(f"{frames} frames: the longest step of the main thread takes {longest}")


def _milliseconds(step):
    clock, processor = (seconds * 1e3 for seconds in step)
    return f"{clock:.1f} ms, of the processor {processor:.1f} ms"


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 72_000)
