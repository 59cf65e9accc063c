"""The segments as bands of colour behind the keys, in the dope sheet and in the non-linear animation editor."""

from typing import Any

import bpy

from .markers import corrected_segments
from .segments import motion_names

BOTTOM, HEIGHT = 46, 10
"""In pixels, above the scroll bar and the names of the markers."""

GAP = 1
# Of Blender's own colour tags, so that the panel's icons have them too.
COLOURS = (
    (0.89, 0.38, 0.36), (0.94, 0.64, 0.36), (0.95, 0.86, 0.33), (0.48, 0.80, 0.48), (0.36, 0.71, 0.92),
    (0.55, 0.35, 0.85), (0.76, 0.38, 0.72), (0.47, 0.33, 0.25), (0.37, 0.37, 0.37),
)  # fmt: skip

_handles: list[tuple[Any, Any]] = []


def bands(scene: Any) -> list[tuple[int, int, tuple[float, float, float], bool]]:
    """First frame, frame after the last, colour, and whether it is discarded, of each segment."""
    state = scene.caesura
    places = {motion.called: place for place, motion in enumerate(state.motions)}
    segments = corrected_segments(scene)
    for name in motion_names(segments):
        places.setdefault(name, len(places))
    first = state.first_frame
    return [(first + s.start, first + s.end, COLOURS[places[s.name] % len(COLOURS)], s.discard) for s in segments]


def draw_bands() -> None:
    """Blender calls this when it draws the editor."""
    context = bpy.context
    if not context.scene.caesura.result_json or context.region.type != "WINDOW":
        return
    import gpu
    from gpu_extras.batch import batch_for_shader

    shader = gpu.shader.from_builtin("UNIFORM_COLOR" if bpy.app.version >= (4, 0, 0) else "2D_UNIFORM_COLOR")
    low, high = (context.preferences.system.ui_scale * height for height in (BOTTOM, BOTTOM + HEIGHT))
    gpu.state.blend_set("ALPHA")
    for start, end, colour, discarded in bands(context.scene):
        left, right = (context.region.view2d.view_to_region(frame, 0, clip=False)[0] for frame in (start, end))
        if right < 0 or left > context.region.width:
            continue
        corners = ((left, low), (right - GAP, low), (right - GAP, high), (left, high))
        batch = batch_for_shader(shader, "TRI_FAN", {"pos": corners})
        shader.bind()
        shader.uniform_float("color", (*colour, 0.25 if discarded else 0.8))
        batch.draw(shader)
    gpu.state.blend_set("NONE")


def register() -> None:
    """Draw from now on."""
    _handles.extend(
        (space, space.draw_handler_add(draw_bands, (), "WINDOW", "POST_PIXEL"))
        for space in (bpy.types.SpaceDopeSheetEditor, bpy.types.SpaceNLA)
    )


def unregister() -> None:
    """Draw no more."""
    while _handles:
        space, handle = _handles.pop()
        space.draw_handler_remove(handle, "WINDOW")
