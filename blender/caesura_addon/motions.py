"""The steps of each thing that a person asks for, to be done in slices."""

import json
import tempfile
import threading
from pathlib import Path
from typing import Any

import bpy

from .actions import key_count, make_actions, name_actions, note_takes, push_strips, remove_actions, restore_takes
from .frame_capture import CaptureError, capture
from .local_service import LocalService
from .markers import corrected_segments, place_markers, remove_markers
from .preferences import NETWORK, online_access
from .segments import Segment, motion_names, revision_of_segments, segments_of_document
from .service_client import ServiceClient, ServiceError
from .sliced_work import Steps, in_thread

LOCAL = LocalService()
MOST_COPIED_KEYS = 250_000
"""Blender copies all keys of a scene in one step: for a step of its undo, and for a scene where a take is evaluated."""


class Wanted:
    """Which service is asked, as the preferences said when the work began: threads do not read Blender's data."""

    def __init__(self, preferences: Any) -> None:
        self._local = preferences.where == "LOCAL"
        self._command = bpy.path.abspath(preferences.command) if preferences.command else ""
        self._address, self._key = preferences.address, preferences.key
        self._online = online_access()

    def connect(self, stop: threading.Event) -> ServiceClient:
        """In a thread: start a local service where it is wanted, and give its client."""
        if self._local:
            return ServiceClient(LOCAL.start(self._command, stop), stop=stop)
        client = ServiceClient(self._address, self._key, stop)
        if not (client.is_local or self._online):
            raise ServiceError(NETWORK)
        return client


def find_motions(scene: Any, target: Any, wanted: Wanted, running: Any) -> Steps:
    """Send the frames of an armature or a mesh, and show the motions that come back."""
    state, report = scene.caesura, running.report
    first, frames = frames_of(scene, target)
    if frames < 2:
        raise CaptureError("The range has one frame. Choose the range that moves.")
    report("asking the service", 0.0)
    limits = yield from in_thread(lambda stop: wanted.connect(stop).limits())
    name = f"{target.name}.{'glb' if target.type == 'ARMATURE' else 'npz'}"
    parameters = asked_parameters(state)
    with tempfile.TemporaryDirectory(prefix="caesura-") as folder:
        path = Path(folder) / "take"
        apart = key_count(state, target) <= MOST_COPIED_KEYS
        yield from capture(target, first, frames, path, limits, running, apart=apart)
        answer = yield from in_thread(lambda stop: _upload_and_segment(wanted, path, name, parameters, report, stop))
    address, animation, document = answer
    found = segments_of_document(document)
    if document["frames"] != frames:
        raise ServiceError(f"The service counts {document['frames']} frames of the {frames} that were sent.")
    state.address, state.animation = address, animation
    if state.target != target:
        yield from remove_actions(_forget(scene))
    state.target = target
    _move_range(scene, first, frames)
    note_takes(state, target)
    state.set_newest_revision(document["id"], document["revision"])
    yield from show_segments(scene, document["id"], found, report)


def change_motions(scene: Any, wanted: Wanted, report: Any) -> Steps:
    """Have the same take cut into another number of motions."""
    state = scene.caesura
    animation, parameters = state.animation, asked_parameters(state)
    document = yield from in_thread(lambda stop: wanted.connect(stop).segment(animation, parameters, report))
    state.set_newest_revision(document["id"], document["revision"])
    yield from show_segments(scene, document["id"], segments_of_document(document), report)


def save_corrections(scene: Any, wanted: Wanted, report: Any) -> Steps:
    """Save the markers as they are as a revision, and cut the actions there."""
    state = scene.caesura
    segmentation = state.result["segmentation"]
    newest, corrected = state.newest_revision(segmentation), corrected_segments(scene)
    edits = revision_of_segments(corrected)
    report("saving", 0.0)
    saved = yield from in_thread(
        lambda stop: wanted.connect(stop).save_revision(segmentation, newest, edits, "edited in Blender")
    )
    state.set_newest_revision(segmentation, saved["revision"])
    yield from show_segments(scene, segmentation, corrected, report)


def undo_change(scene: Any, report: Any) -> Steps:
    """Show the result that was there before the last change."""
    state = scene.caesura
    history = json.loads(state.history_json)
    before = history.pop()
    yield from show_segments(scene, before["segmentation"], [Segment(*row) for row in before["segments"]], report)
    state.history_json = json.dumps(history)


def remove_motions(scene: Any) -> Steps:
    """Take markers, strips and their actions away, and put the take back."""
    yield from remove_actions(_forget(scene))


def show_segments(scene: Any, segmentation: str, segments: list[Segment], report: Any) -> Steps:
    """Make markers, actions and strips of segments, in place of those that are there."""
    state = scene.caesura
    made = yield from make_actions(state, segments, report)
    old = yield from push_strips(state, segments, made)
    place_markers(scene, segments)
    state.remember()
    state.set_result(segmentation, segments)
    _list_motions(state, segments)
    yield
    yield from remove_actions(old)
    name_actions(state)
    _push_undo(state)


def frames_of(scene: Any, target: Any) -> tuple[int, int]:
    """The first frame that is sent, and how many are."""
    data = target.animation_data
    known = [take.action for take in scene.caesura.takes if take.owner == target]
    action = (data.action if data else None) or (known[0] if known else None)
    if scene.caesura.frame_range == "ACTION" and action is not None:
        first, last = (int(frame) for frame in action.frame_range)
    elif scene.use_preview_range:
        first, last = scene.frame_preview_start, scene.frame_preview_end
    else:
        first, last = scene.frame_start, scene.frame_end
    return first, last - first + 1


def asked_parameters(state: Any) -> dict[str, Any]:
    """What is asked of the service."""
    return {"motions": "auto" if state.choose_motions else state.motion_count}


def _upload_and_segment(
    wanted: Wanted, path: Path, name: str, parameters: dict[str, Any], report: Any, stop: threading.Event
) -> tuple[str, str, dict[str, Any]]:
    client = wanted.connect(stop)
    animation = client.upload(path, name, report)
    return client.address, animation, client.segment(animation, parameters, report)


def _move_range(scene: Any, first: int, frames: int) -> None:
    """Take the markers of the last result away before the frames that they are counted from change."""
    state = scene.caesura
    if (state.first_frame, state.frame_count) != (first, frames):
        remove_markers(scene)
        state.result_json, state.history_json = "", "[]"
        state.first_frame, state.frame_count = first, frames


def _forget(scene: Any) -> list[Any]:
    state = scene.caesura
    remove_markers(scene)
    old = restore_takes(state)
    state.result_json, state.history_json, state.target = "", "[]", None
    state.motions.clear()
    return old


def _list_motions(state: Any, segments: list[Segment]) -> None:
    state.motions.clear()
    for name in motion_names(segments):
        motion = state.motions.add()
        motion.name = name
        motion.called = name
        same = [segment for segment in segments if segment.name == name]
        motion.discard = all(segment.discard for segment in same)
        motion.loop = any(segment.loop for segment in same)


def _push_undo(state: Any) -> None:
    """Let Ctrl+Z take it back, where Blender can keep it quickly; the panel's undo always does."""
    few = state.target is None or key_count(state, state.target) <= MOST_COPIED_KEYS
    if few and bpy.ops.ed.undo_push.poll():
        bpy.ops.ed.undo_push(message="Caesura")
