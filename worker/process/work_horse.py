"""A work-horse: a fork of the worker that stands ready before its job comes, and may do several of one kind.

A fork of a process that has everything loaded takes ten milliseconds, and the first touch of every page it shares as
long again: more than a cut. So it is made while nobody waits. It lives in a process of its own, as RQ's do: what it
takes too much of ends it alone, and the next one is forked.
"""

import ctypes
import os
import signal
import socket
import sys
from collections.abc import Callable

from caesura.worker.parent_watch import end_with_parent

PR_SET_NAME = 15
READY, WORKING = "horse: ready", "horse: working"
"""What `ps` and `top` call it; at most 15 letters."""

WorkFunction = Callable[[str], bool]
"""Does the job that an order names, in the fork; whether the fork may do another."""


class WorkHorse:
    """The worker's hand on one fork. It ends when this is let go: `close`, or the end of the worker.

    A timer of the worker's raises in `wait` every few seconds, and may do so just as the job is over. So the report is
    looked at there and not taken, and the status is written down before the timer may strike: the next call finds both.
    """

    def __init__(self, prepare: Callable[[], None], work: WorkFunction) -> None:
        orders, self._orders = os.pipe()
        self._reports, reports = socket.socketpair()  # a pipe cannot be looked into
        self._reported = False
        self.status: int | None = None
        """How it ended, as `os.wait` has it; None while it lives."""
        parent = os.getpid()
        self.pid = os.fork()
        if self.pid == 0:
            os.close(self._orders)
            self._reports.close()
            try:
                _do_jobs(parent, orders, reports, prepare, work)
            finally:
                os._exit(1)
        os.close(orders)
        reports.close()

    def start_job(self, order: str) -> bool:
        """Let it do a job; False where it has ended meanwhile."""
        if self._reported:
            self._reports.recv(1)
            self._reported = False
        try:
            os.write(self._orders, order.encode() + b"\n")
        except BrokenPipeError:
            return False
        return True

    def wait(self) -> tuple[int, int]:
        """Until the job is done, or the fork has ended: its process id, and its status as `os.wait` has it."""
        if self.status is None and self._reports.recv(1, socket.MSG_PEEK):
            self._reported = True
            return self.pid, os.EX_OK
        return self.pid, self._await_end()

    def close(self) -> None:
        """It gets no more orders, and ends."""
        os.close(self._orders)
        self._reports.close()
        self._await_end()

    def _await_end(self) -> int:
        if self.status is None:
            held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGALRM})
            try:
                _, self.status = os.waitpid(self.pid, 0)
            finally:
                signal.pthread_sigmask(signal.SIG_SETMASK, held)
        return self.status


def _do_jobs(parent: int, orders: int, reports: socket.socket, prepare: Callable[[], None], work: WorkFunction) -> None:
    """In the fork: one job after the other, as long as it may."""
    os.setpgrp()  # what it starts is killed with it
    end_with_parent(parent)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    _set_process_name(READY)
    prepare()
    with os.fdopen(orders) as lines:
        for order in iter(lines.readline, ""):
            _set_process_name(WORKING)
            again = work(order.rstrip("\n"))
            if not again:
                os._exit(os.EX_OK)
            _set_process_name(READY)
            reports.send(b".")
    os._exit(os.EX_OK)


def _set_process_name(name: str) -> None:
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_NAME, name.encode())
