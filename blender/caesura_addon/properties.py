"""What a scene keeps: what is asked for, and the result. It is saved with the file, and undone with it."""

import json
from typing import Any

import bpy

from .segments import Segment

LONGEST_HISTORY = 20


class TakeAction(bpy.types.PropertyGroup):
    """An action that the take was before it was cut, and whose it is."""

    owner: bpy.props.PointerProperty(type=bpy.types.Object)
    of_shape_keys: bpy.props.BoolProperty()
    action: bpy.props.PointerProperty(type=bpy.types.Action)
    slot: bpy.props.StringProperty(description="the identifier of its slot, where actions have slots")

    @property
    def animated(self) -> Any:
        """What the action moves: the object, or its mesh's shape keys."""
        return self.owner.data.shape_keys if self.of_shape_keys else self.owner


def _name_changed(motion: "Motion", _context: bpy.types.Context) -> None:
    if motion.called and motion.name and motion.name != motion.called:
        from .actions import rename_actions
        from .markers import rename_markers

        rename_markers(motion.id_data, motion.called, motion.name)
        rename_actions(motion.id_data.caesura, motion.called, motion.name)
        motion.called = motion.name


def _loop_changed(motion: "Motion", _context: bpy.types.Context) -> None:
    from .actions import flag_loops

    flag_loops(motion.id_data.caesura, motion.called, motion.loop)


class Motion(bpy.types.PropertyGroup):
    """A motion as the panel shows it. `called` is what its markers are called now."""

    name: bpy.props.StringProperty(
        name="Name", description="Renames the markers and the actions of the motion", update=_name_changed
    )
    called: bpy.props.StringProperty()
    loop: bpy.props.BoolProperty(name="Loop", description="Its clips go round", update=_loop_changed)
    discard: bpy.props.BoolProperty(name="Discard", description="It is to be no clip")


class SceneMotions(bpy.types.PropertyGroup):
    """What is asked for, and the result, as JSON of what is not to be edited by hand."""

    frame_range: bpy.props.EnumProperty(
        name="Range",
        items=(
            ("ACTION", "Action", "All frames of the action; of the scene where there is none"),
            ("SCENE", "Scene", "The frames that are played: the preview range where it is on"),
        ),
        default="ACTION",
    )
    choose_motions: bpy.props.BoolProperty(name="Auto", description="Let the service choose the number", default=True)
    motion_count: bpy.props.IntProperty(name="Motions", min=1, max=200, default=5)

    target: bpy.props.PointerProperty(type=bpy.types.Object)
    takes: bpy.props.CollectionProperty(type=TakeAction)
    motions: bpy.props.CollectionProperty(type=Motion)
    first_frame: bpy.props.IntProperty()
    frame_count: bpy.props.IntProperty()
    address: bpy.props.StringProperty()
    animation: bpy.props.StringProperty()
    result_json: bpy.props.StringProperty()
    history_json: bpy.props.StringProperty(default="[]")
    other_markers_json: bpy.props.StringProperty(default="[]")
    revisions_json: bpy.props.StringProperty(default="{}")

    @property
    def result(self) -> dict[str, Any] | None:
        """The segmentation's id, and its segments as they were when they became markers."""
        return json.loads(self.result_json) if self.result_json else None

    @property
    def segments(self) -> list[Segment]:
        """Those of the result."""
        found = self.result
        return [Segment(*values) for values in found["segments"]] if found else []

    def remember(self) -> None:
        """Put the result on the history, for the panel's undo."""
        if self.result_json:
            history = [*json.loads(self.history_json), self.result][-LONGEST_HISTORY:]
            self.history_json = json.dumps(history)

    def set_result(self, segmentation: str, segments: list[Segment]) -> None:
        """Replace the result."""
        rows = [[s.start, s.end, s.name, s.loop, s.discard] for s in segments]
        self.result_json = json.dumps({"segmentation": segmentation, "segments": rows})

    def newest_revision(self, segmentation: str) -> int:
        """The newest that is known here."""
        return int(json.loads(self.revisions_json).get(segmentation, 0))

    def set_newest_revision(self, segmentation: str, revision: int) -> None:
        """Note one that was saved."""
        self.revisions_json = json.dumps({**json.loads(self.revisions_json), segmentation: revision})
