"""Work in slices: a generator that yields often, resumed for a bounded time, so that the window can be drawn between.

A generator yields `WAIT` where it can only go on later, such as while a thread is at work, and anything else after a
step.
"""

import threading
import time
from collections.abc import Callable, Generator
from typing import Any

WAIT = object()

Steps = Generator[Any, None, Any]


class Cancelled(Exception):
    """Somebody has asked the work to end."""


class SliceEnd:
    """What is to be called when a slice ends, before anything is drawn."""

    call: Callable[[], None] | None = None


class SlicedWork:
    """A generator, and how long its longest slice has taken, in seconds: by the clock, and of the processor."""

    def __init__(self, steps: Steps, budget_seconds: float, slice_end: SliceEnd | None = None) -> None:
        self._steps = steps
        self._budget = budget_seconds
        self._end = slice_end or SliceEnd()
        self.longest = 0.0
        self.longest_computed = 0.0

    def resume(self) -> bool:
        """Go on for the budget, or until it has to wait; False at the end. Raises what the work raises."""
        begun, computed = time.perf_counter(), time.thread_time()
        try:
            while time.perf_counter() - begun < self._budget:
                if next(self._steps) is WAIT:
                    return True
        except StopIteration:
            return False
        finally:
            if self._end.call is not None:
                self._end.call()
            self.longest = max(self.longest, time.perf_counter() - begun)
            self.longest_computed = max(self.longest_computed, time.thread_time() - computed)
        return True

    def close(self) -> None:
        """End it where it stands."""
        self._steps.close()


def in_thread(function: Callable[[threading.Event], Any]) -> Steps:
    """The steps of waiting for `function` in a thread: its answer, or what it raises.

    It is given an event that is set when nobody waits for it any more.
    """
    stop = threading.Event()
    found: dict[str, Any] = {}

    def run() -> None:
        try:
            found["answer"] = function(stop)
        except BaseException as problem:  # noqa: BLE001  raised where it is waited for
            found["problem"] = problem

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        while thread.is_alive():
            yield WAIT
    finally:
        stop.set()
    if "problem" in found:
        raise found["problem"]
    return found["answer"]
