"""The panel, in the side bars of the dope sheet and of the 3D view: tab Caesura."""

from typing import Any

import bpy

from .markers import corrected_segments
from .motions import frames_of
from .running_work import RUNNING
from .segments import motion_names

COLOUR_ICONS = 9
ICONS = "STRIP_COLOR_" if hasattr(bpy.types, "Strip") else "SEQUENCE_COLOR_"


def colour_icon(place: int) -> str:
    """The icon in the colour that the time line gives to a motion."""
    return f"{ICONS}{place % COLOUR_ICONS + 1:02}"


class _MotionsPanel:
    """What both panels draw."""

    bl_region_type = "UI"
    bl_category = "Caesura"
    bl_label = "Motions"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw what fits the moment."""
        layout: Any = self.layout
        if RUNNING.work is not None:
            _draw_progress(layout)
            return
        if RUNNING.problem:
            _draw_problem(layout, RUNNING.problem, context)
        _draw_request(layout, context)
        if context.scene.caesura.result_json:
            _draw_result(layout, context.scene)


def _draw_progress(layout: Any) -> None:
    text = f"{RUNNING.stage.replace('-', ' ').replace('_', ' ')} {RUNNING.fraction:.0%}"
    if hasattr(layout, "progress"):
        layout.progress(factor=RUNNING.fraction, text=text)
    else:
        layout.label(text=text)
    layout.operator("caesura.cancel", icon="CANCEL")


def _draw_problem(layout: Any, problem: str, context: bpy.types.Context) -> None:
    box = layout.box()
    width = max(context.region.width // 8, 20) if context.region else 40
    line = ""
    for word in problem.split():
        if line and len(line) + len(word) >= width:
            box.label(text=line)
            line = ""
        line = f"{line} {word}".strip()
    box.label(text=line)


def _draw_request(layout: Any, context: bpy.types.Context) -> None:
    state, target = context.scene.caesura, context.object
    if target is None or target.type not in {"ARMATURE", "MESH"}:
        layout.label(text="Select an armature or a mesh.", icon="INFO")
    else:
        first, frames = frames_of(context.scene, target)
        icon = "ARMATURE_DATA" if target.type == "ARMATURE" else "MESH_DATA"
        layout.label(text=f"{target.name}: frames {first} to {first + frames - 1}", icon=icon)
    layout.prop(state, "frame_range")
    row = layout.row(align=True)
    row.prop(state, "choose_motions", toggle=True)
    count = row.row(align=True)
    count.active = not state.choose_motions
    count.prop(state, "motion_count")
    layout.operator("caesura.find", icon="VIEWZOOM")


def _draw_result(layout: Any, scene: Any) -> None:
    state = scene.caesura
    row = layout.row(align=True)
    row.operator("caesura.change", icon="FILE_REFRESH")
    row.operator("caesura.undo", icon="LOOP_BACK", text="")
    row.operator("caesura.remove", icon="X", text="")
    segments = corrected_segments(scene)
    layout.label(text=f"{len(motion_names(segments))} motions, {len(segments)} segments")
    column = layout.column(align=True)
    for place, motion in enumerate(state.motions):
        count = sum(segment.name == motion.called for segment in segments)
        row = column.row(align=True)
        row.label(text="", icon=colour_icon(place))
        row.prop(motion, "name", text="")
        row.label(text=f"× {count}")
        row.prop(motion, "loop", text="", icon="CON_FOLLOWPATH" if motion.loop else "FORWARD", toggle=True)
        row.prop(motion, "discard", text="", icon="TRASH", toggle=True)
    changed = segments != state.segments
    row = layout.row(align=True)
    row.alert = changed
    row.operator("caesura.save", icon="FILE_TICK", text="Save Corrections" if changed else "Save Revision")
    row.operator("caesura.open_page", icon="URL", text="")


class CAESURA_PT_dope_sheet(_MotionsPanel, bpy.types.Panel):
    """In the dope sheet and the action editor."""

    bl_idname = "CAESURA_PT_dope_sheet"
    bl_space_type = "DOPESHEET_EDITOR"


class CAESURA_PT_view(_MotionsPanel, bpy.types.Panel):
    """In the 3D view."""

    bl_idname = "CAESURA_PT_view"
    bl_space_type = "VIEW_3D"


CLASSES = (CAESURA_PT_dope_sheet, CAESURA_PT_view)
