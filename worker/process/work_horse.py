"""A work-horse: a fork of the worker that stands ready before its job comes, and may do several of one kind.

A fork of a process that has everything loaded takes ten milliseconds, and the first touch of every page it shares as
long again: more than a cut. So it is made while nobody waits. It lives in a process of its own, as RQ's do: what it
takes too much of ends it alone, and the next one is forked.
"""

import ctypes
import os
import signal
import sys
from collections.abc import Callable
from resource import struct_rusage

from caesura.worker.parent_watch import end_with_parent

PR_SET_NAME = 15
READY, WORKING = "horse: ready", "horse: working"
"""What `ps` and `top` call it; at most 15 letters."""

WorkFunction = Callable[[str], bool]
"""Does the job that an order names, in the fork; whether the fork may do another."""


class WorkHorse:
    """The worker's hand on one fork. It ends when this is let go: `dismiss`, or the end of the worker."""

    def __init__(self, prepare: Callable[[], None], work: WorkFunction) -> None:
        orders, self._orders = os.pipe()
        self._reports, reports = os.pipe()
        parent = os.getpid()
        self.pid = os.fork()
        if self.pid == 0:
            os.close(self._orders)
            os.close(self._reports)
            try:
                _serve(parent, orders, reports, prepare, work)
            finally:
                os._exit(1)
        os.close(orders)
        os.close(reports)

    def give(self, order: str) -> bool:
        """Let it do a job; False where it has ended meanwhile."""
        try:
            os.write(self._orders, order.encode() + b"\n")
        except BrokenPipeError:
            return False
        return True

    def wait(self) -> tuple[int, int, struct_rusage | None]:
        """Until the job is done, or the fork has ended: its process id, exit status, and what it used."""
        if os.read(self._reports, 1):
            return self.pid, os.EX_OK, None
        pid, status, used = os.wait4(self.pid, 0)
        return pid, status, used

    def close(self) -> None:
        """It gets no more orders, and ends."""
        os.close(self._orders)
        os.close(self._reports)


def _serve(parent: int, orders: int, reports: int, prepare: Callable[[], None], work: WorkFunction) -> None:
    """In the fork: one job after the other, as long as it may."""
    os.setpgrp()  # what it starts is killed with it
    end_with_parent(parent)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    _call_it(READY)
    prepare()
    with os.fdopen(orders) as lines:
        for order in iter(lines.readline, ""):
            _call_it(WORKING)
            again = work(order.rstrip("\n"))
            if not again:
                os._exit(os.EX_OK)
            _call_it(READY)
            os.write(reports, b".")
    os._exit(os.EX_OK)


def _call_it(name: str) -> None:
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_NAME, name.encode())
