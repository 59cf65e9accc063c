"""SIGTERM as Ctrl-C: what has begun ends in order, and what is done is said."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class Terminated(KeyboardInterrupt):
    """The command was told to end by SIGTERM."""


@contextmanager
def termination_as_interrupt() -> Iterator[None]:
    """Have SIGTERM raise `Terminated`; outside the main thread, which alone may take signals, nothing changes."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, _interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    raise Terminated
