"""The add-on as a person has it: the zip installed into a Blender without settings, and its timer driven by hand.

The module bpy has no window and no event loop, so nothing calls its timers: `finish` does what the loop would do.
"""

import sys
import time

import bpy

MODULE = "bl_ext.user_default.caesura"


def install(zip_path, address="", command=""):
    """Install the zip, and set its preferences."""
    bpy.ops.extensions.package_install_files(filepath=str(zip_path), repo="user_default", enable_on_install=True)
    preferences = bpy.context.preferences.addons[MODULE].preferences
    preferences.where = "ADDRESS" if address else "LOCAL"
    preferences.address, preferences.command = address, command
    for known in list(bpy.data.objects):
        bpy.data.objects.remove(known)


def running():
    """What runs now."""
    return sys.modules[f"{MODULE}.running_work"]


def finish(seconds=300.0):
    """Call the timer until the work ends; the longest slice in seconds, by the clock and of the processor.

    Raises what the panel would show.
    """
    work, deadline = running(), time.monotonic() + seconds
    while (pause := work.tick()) is not None:
        assert time.monotonic() < deadline, f"still {work.RUNNING.stage}"
        time.sleep(pause)
    if work.RUNNING.problem:
        raise RuntimeError(work.RUNNING.problem)
    return work.RUNNING.longest, work.RUNNING.longest_computed
