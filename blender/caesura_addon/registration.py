"""What Blender is told of when the add-on is enabled, and what ends with it."""

import atexit

import bpy

from . import operators, panel, timeline_bands
from .motions import LOCAL
from .preferences import CaesuraPreferences
from .properties import Motion, SceneMotions, TakeAction
from .running_work import RUNNING

CLASSES = (CaesuraPreferences, TakeAction, Motion, SceneMotions, *operators.CLASSES, *panel.CLASSES)


@bpy.app.handlers.persistent
def _end_work(*_: object) -> None:
    """References into Blender's data are void after an undo, and after another file is opened."""
    RUNNING.cancel()


def _handlers() -> tuple[list[object], ...]:
    found = bpy.app.handlers
    return found.undo_pre, found.redo_pre, found.load_pre


def register() -> None:
    """Add classes, the scene's property, handlers and drawing."""
    for known in CLASSES:
        bpy.utils.register_class(known)
    bpy.types.Scene.caesura = bpy.props.PointerProperty(type=SceneMotions)
    for handlers in _handlers():
        handlers.append(_end_work)
    if not bpy.app.background:
        timeline_bands.register()
    atexit.register(LOCAL.stop)


def unregister() -> None:
    """Take all of it away, and end the local service."""
    RUNNING.cancel()
    LOCAL.stop()
    atexit.unregister(LOCAL.stop)
    timeline_bands.unregister()
    for handlers in _handlers():
        if _end_work in handlers:
            handlers.remove(_end_work)
    del bpy.types.Scene.caesura
    for known in reversed(CLASSES):
        bpy.utils.unregister_class(known)
