"""Frames of an object evaluated one by one, one a step. A thread writes them to a file meanwhile."""

import queue
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from .service_client import ServiceError
from .skeleton_file import SkeletonFile
from .sliced_work import WAIT, SliceEnd, Steps, in_thread
from .vertex_file import BLOCK_BYTES, VertexFile

SCENE_NAME = "Caesura is reading"
BLOCK_FRAMES = 256
WAITING_BLOCKS = 8


class CaptureError(Exception):
    """What of the object cannot be sent, and what to do."""


def capture(
    target: Any, first: int, frames: int, path: Path, limits: dict[str, Any], running: Any, *, apart: bool
) -> Steps:
    """Write frames [first, first + frames) of an armature or a mesh; raises `CaptureError`."""
    if target.type not in {"ARMATURE", "MESH"}:
        raise CaptureError(f"{target.name!r} is no armature and no mesh. Select what moves.")
    with _evaluation_of(target, running.slice_end, apart=apart) as evaluate:
        evaluated = evaluate(first)
        yield
        kind = _Bones if target.type == "ARMATURE" else _Vertices
        source = kind(target, evaluated, frames, path, limits)
        yield
        blocks: queue.Queue[Any] = queue.Queue(WAITING_BLOCKS)
        written = in_thread(lambda stop: _write(source, blocks, stop))
        try:
            for start in range(0, frames, source.block_frames):
                count = min(source.block_frames, frames - start)
                block, worlds = np.empty((count, *source.shape), np.float32), np.empty((count, 4, 4))
                for at in range(count):
                    evaluated = evaluate(first + start + at)
                    source.read(evaluated, block[at], first + start + at)
                    worlds[at] = evaluated.matrix_world
                    running.report("reading frames", (start + at) / frames)
                    yield
                yield from _put(blocks, (block, worlds), written)
            yield from _put(blocks, None, written)
            yield from written
        finally:
            written.close()


def _put(blocks: "queue.Queue[Any]", item: Any, written: Steps) -> Steps:
    while blocks.full():
        next(written)  # raises what the thread raises
        yield WAIT
    blocks.put_nowait(item)


def _write(source: Any, blocks: "queue.Queue[Any]", stop: threading.Event) -> None:
    while not stop.is_set():
        try:
            item = blocks.get(timeout=0.2)
        except queue.Empty:
            continue
        if item is None:
            source.finish()
            return
        source.write(*item)


@contextmanager
def _evaluation_of(target: Any, slice_end: SliceEnd, *, apart: bool) -> Iterator[Callable[[int], Any]]:
    """A function that evaluates a frame and answers with the evaluated object.

    Apart, in a scene of its own, the user's scene does not notice. That scene has copies of all keys, made in one
    step. So a take of very many is evaluated in the user's scene, which is back on its frame before it is drawn.
    Scene and object are looked up by name each time: an undo replaces them.
    """
    name, here = target.name, bpy.context.scene
    scene = _scene_of(target, here) if apart else here
    called, away = scene.name, None

    def evaluate(frame: int) -> Any:
        nonlocal away
        found, owner = bpy.data.objects.get(name), bpy.data.scenes.get(called)
        if found is None or owner is None:
            raise CaptureError(f"{name!r} was changed while it was read. Find the motions again.")
        if away is None and not apart:
            away = owner.frame_current_final
        owner.frame_set(frame)
        layer = owner.view_layers[0] if apart else bpy.context.view_layer
        return found.evaluated_get(layer.depsgraph)

    def come_back() -> None:
        nonlocal away
        owner = bpy.data.scenes.get(called)
        if away is not None and owner is not None:
            owner.frame_set(int(away // 1), subframe=away % 1)
        away = None

    slice_end.call = come_back
    try:
        yield evaluate
    finally:
        come_back()
        slice_end.call = None
        if apart and (owner := bpy.data.scenes.get(called)) is not None:
            bpy.data.scenes.remove(owner)


def _scene_of(target: Any, here: Any) -> Any:
    """A scene with the object alone, and what it depends on, at the same rate."""
    scene = bpy.data.scenes.new(SCENE_NAME)
    for setting in ("fps", "fps_base", "frame_map_old", "frame_map_new"):
        setattr(scene.render, setting, getattr(here.render, setting))
    scene.collection.objects.link(target)
    return scene


class _Bones:
    """The bones of an armature, parents first."""

    block_frames = BLOCK_FRAMES

    def __init__(self, target: Any, evaluated: Any, frames: int, path: Path, limits: dict[str, Any]) -> None:
        bones = list(evaluated.pose.bones)
        if not bones:
            raise CaptureError(f"The armature {target.name!r} has no bones.")
        places = {bone.name: place for place, bone in enumerate(bones)}
        parents = [places[bone.parent.name] if bone.parent else -1 for bone in bones]
        order = sorted(range(len(bones)), key=lambda place: len(bones[place].parent_recursive))
        rank = {place: at for at, place in enumerate(order)}
        self._order = np.array(order)
        _check_upload(frames * len(bones) * 40, limits)
        self._path = path
        self._file = SkeletonFile(
            frames,
            [bones[place].name for place in order],
            [rank.get(parents[place], -1) for place in order],
            [bones[place].bone.length for place in order],
            _frame_rate(),
        )
        self.shape = (len(bones), 16)

    def read(self, evaluated: Any, room: Any, _frame: int) -> None:
        """The bones in the armature's space, by columns."""
        evaluated.pose.bones.foreach_get("matrix", room.reshape(-1))

    def write(self, block: Any, worlds: Any) -> None:
        """In the thread."""
        bones = block.reshape(len(block), -1, 4, 4).transpose(0, 1, 3, 2)
        self._file.write(bones[:, self._order].astype(np.float64), worlds)

    def finish(self) -> None:
        """In the thread."""
        self._file.save(self._path)


class _Vertices:
    """The vertices of a mesh with its modifiers."""

    def __init__(self, target: Any, evaluated: Any, frames: int, path: Path, limits: dict[str, Any]) -> None:
        mesh = evaluated.data
        self._count = len(mesh.vertices)
        mesh.calc_loop_triangles()
        triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", triangles)
        if not len(triangles):
            raise CaptureError(f"The mesh {target.name!r} has no faces.")
        _check_upload(frames * self._count * 12, limits)
        self._name = target.name
        self.shape = (self._count, 3)
        self.block_frames = int(np.clip(BLOCK_BYTES // (12 * self._count), 1, BLOCK_FRAMES))
        self._file = VertexFile(path, frames, self._count, triangles, _frame_rate())

    def read(self, evaluated: Any, room: Any, frame: int) -> None:
        """The vertices in the object's space."""
        vertices = evaluated.data.vertices
        if len(vertices) != self._count:
            raise CaptureError(
                f"{self._name!r} has {len(vertices)} vertices in frame {frame} and {self._count} in the first. Turn "
                "off the modifier that changes their number."
            )
        vertices.foreach_get("co", room.reshape(-1))

    def write(self, block: Any, worlds: Any) -> None:
        """In the thread."""
        self._file.write(block, worlds)

    def finish(self) -> None:
        """In the thread."""
        self._file.close()


def _check_upload(size: int, limits: dict[str, Any]) -> None:
    most = limits.get("max_upload_bytes", 2**62)
    if size > most:
        raise ServiceError(
            f"The take would be {size / 1e6:,.0f} MB; this service takes {most / 1e6:,.0f}. Choose fewer frames, or "
            "the armature in place of its mesh."
        )


def _frame_rate() -> float:
    render = bpy.context.scene.render
    return render.fps / render.fps_base
