"""The markers of a result, among those that were there before."""

import json
from typing import Any

from .segments import Mark, Segment, marks_of_segments, motion_names, own_marks, segments_of_marks


def own_markers(scene: Any) -> list[Any]:
    """Those that say where segments begin; one that binds a camera is none."""
    state = scene.caesura
    if not state.result_json:
        return []
    others = [Mark(*values) for values in json.loads(state.other_markers_json)]
    motions = [*motion_names(state.segments), *(motion.called for motion in state.motions)]
    markers = [marker for marker in scene.timeline_markers if marker.camera is None]
    own = set(own_marks((Mark(marker.name, marker.frame) for marker in markers), others, motions))
    return [marker for marker in markers if Mark(marker.name, marker.frame) in own]


def place_markers(scene: Any, segments: list[Segment]) -> None:
    """Replace the markers of the result that was there by those of `segments`."""
    state = scene.caesura
    for marker in own_markers(scene):
        scene.timeline_markers.remove(marker)
    others = [[marker.name, marker.frame] for marker in scene.timeline_markers]
    state.other_markers_json = json.dumps(others)
    for mark in marks_of_segments(segments, state.first_frame):
        scene.timeline_markers.new(mark.name, frame=mark.frame)


def remove_markers(scene: Any) -> None:
    """Leave only what was there before."""
    for marker in own_markers(scene):
        scene.timeline_markers.remove(marker)


def corrected_segments(scene: Any) -> list[Segment]:
    """The segments as the markers now say, with the motions that the panel marks as loops or discards."""
    state = scene.caesura
    loops = [motion.called for motion in state.motions if motion.loop]
    discards = [motion.called for motion in state.motions if motion.discard]
    marks = [Mark(marker.name, marker.frame) for marker in own_markers(scene)]
    return segments_of_marks(marks, state.first_frame, state.frame_count, loops, discards)


def rename_markers(scene: Any, old: str, new: str) -> None:
    """Call the markers of a motion otherwise."""
    for marker in own_markers(scene):
        if marker.name == old:
            marker.name = new
