"""What the buttons of the panel do: each starts a work, and Blender goes on."""

from typing import Any

import bpy

from .motions import Wanted, change_motions, find_motions, remove_motions, save_corrections, undo_change
from .preferences import preferences
from .running_work import RUNNING


def _is_idle() -> bool:
    return RUNNING.work is None


class _Result:
    """An operator that needs a result."""

    bl_options = {"REGISTER"}  # noqa: RUF012  Blender reads a set

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether there is a result, and nothing runs."""
        return _is_idle() and bool(context.scene.caesura.result_json)


class CAESURA_OT_find(bpy.types.Operator):
    """Send the active armature or mesh to the service, and show the motions that it finds."""

    bl_idname = "caesura.find"
    bl_label = "Find Motions"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """An armature or a mesh is active."""
        target = context.object
        return _is_idle() and target is not None and target.type in {"ARMATURE", "MESH"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Start."""
        RUNNING.start(find_motions(context.scene, context.object, Wanted(preferences(context)), RUNNING))
        return {"FINISHED"}


class CAESURA_OT_change(_Result, bpy.types.Operator):
    """Cut the same take into the number of motions above."""

    bl_idname = "caesura.change"
    bl_label = "Cut Again"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Start."""
        RUNNING.start(change_motions(context.scene, Wanted(preferences(context)), RUNNING.report))
        return {"FINISHED"}


class CAESURA_OT_save(_Result, bpy.types.Operator):
    """Save the markers as they are now as a revision, and cut the actions there."""

    bl_idname = "caesura.save"
    bl_label = "Save Corrections"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Start."""
        RUNNING.start(save_corrections(context.scene, Wanted(preferences(context)), RUNNING.report))
        return {"FINISHED"}


class CAESURA_OT_undo(_Result, bpy.types.Operator):
    """Go back to the cuts before the last change."""

    bl_idname = "caesura.undo"
    bl_label = "Undo Change"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There is something to go back to."""
        return super().poll(context) and context.scene.caesura.history_json != "[]"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Start."""
        RUNNING.start(undo_change(context.scene, RUNNING.report))
        return {"FINISHED"}


class CAESURA_OT_remove(_Result, bpy.types.Operator):
    """Remove markers, strips and named actions, and put the take back."""

    bl_idname = "caesura.remove"
    bl_label = "Remove Motions"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Start."""
        RUNNING.start(remove_motions(context.scene))
        return {"FINISHED"}


class CAESURA_OT_open_page(_Result, bpy.types.Operator):
    """Show the result in the service's own page, beside its energy curve."""

    bl_idname = "caesura.open_page"
    bl_label = "Open in Browser"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Open it."""
        state: Any = context.scene.caesura
        bpy.ops.wm.url_open(url=f"{state.address}/view/{state.result['segmentation']}")
        return {"FINISHED"}


class CAESURA_OT_cancel(bpy.types.Operator):
    """End what runs; what was there before stays."""

    bl_idname = "caesura.cancel"
    bl_label = "Cancel"

    def execute(self, _context: bpy.types.Context) -> set[str]:
        """End it."""
        RUNNING.cancel()
        return {"FINISHED"}


CLASSES = (
    CAESURA_OT_find, CAESURA_OT_change, CAESURA_OT_save, CAESURA_OT_undo, CAESURA_OT_remove, CAESURA_OT_open_page,
    CAESURA_OT_cancel,
)  # fmt: skip
