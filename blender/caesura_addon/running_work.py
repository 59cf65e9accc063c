"""What runs now: one work at a time, resumed by a timer, for a part of each moment that Blender is idle."""

from typing import Any

import bpy

from .sliced_work import Cancelled, SlicedWork, SliceEnd, Steps

BUDGET_SECONDS = 0.015
PAUSE_SECONDS = 0.01


class RunningWork:
    """A work, what it says of itself, and how it ended."""

    def __init__(self) -> None:
        self.work: SlicedWork | None = None
        self.stage, self.fraction, self.problem = "", 0.0, ""
        self.longest = self.longest_computed = 0.0
        self.slice_end = SliceEnd()

    def start(self, steps: Steps) -> None:
        """Begin; `RuntimeError` while another runs."""
        if self.work is not None:
            raise RuntimeError("one work at a time")
        self.stage, self.fraction, self.problem = "beginning", 0.0, ""
        self.work = SlicedWork(steps, BUDGET_SECONDS, self.slice_end)
        bpy.app.timers.register(tick)

    def report(self, stage: str, fraction: float) -> None:
        """What the panel shows; from any thread."""
        self.stage, self.fraction = stage, fraction

    def cancel(self, *_: Any) -> None:
        """End it where it stands. Also a handler: after an undo, references into Blender's data are void."""
        work, self.work = self.work, None
        if work is not None:
            work.close()


RUNNING = RunningWork()


def tick() -> float | None:
    """The timer: one slice."""
    work = RUNNING.work
    if work is None:
        return None
    goes_on = False
    try:
        goes_on = work.resume()
    except Cancelled:
        pass
    except Exception as problem:  # noqa: BLE001  shown in the panel; the console has the rest
        RUNNING.problem = _sentence(problem)
    RUNNING.longest, RUNNING.longest_computed = work.longest, work.longest_computed
    if not goes_on:
        RUNNING.work = None
    redraw()
    return PAUSE_SECONDS if goes_on else None


def redraw() -> None:
    """Draw the panels anew."""
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            for area in window.screen.areas:
                if area.type in {"DOPESHEET_EDITOR", "VIEW_3D", "NLA_EDITOR"}:
                    area.tag_redraw()


def _sentence(problem: Exception) -> str:
    from .frame_capture import CaptureError
    from .service_client import ServiceError

    if isinstance(problem, (CaptureError, ServiceError)):
        return str(problem)
    if isinstance(problem, ReferenceError):
        return "What was worked on has been removed. Find the motions again."
    import traceback

    traceback.print_exception(problem)
    return f"The add-on failed: {type(problem).__name__}: {problem}. The console has the details."
