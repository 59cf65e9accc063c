"""Worker processes of one machine: forked from one warmed process, started again where they end, stopped in order."""

import logging
import os
import signal
import time
from collections.abc import Callable
from contextlib import suppress

from redis.exceptions import RedisError

from caesura.worker.parent_watch import end_with_parent, parent_is_gone

log = logging.getLogger(__name__)

LOOK_SECONDS = 0.1
MAINTENANCE_SECONDS = 5.0
RESTART_SECONDS = 1.0
KILL_SECONDS = 5.0

WorkFunction = Callable[[list[str]], None]


class WorkerPool:
    """One child per list of queues, each running `work(queues)`; `tend` is called every few seconds.

    The first SIGTERM or SIGINT lets running jobs end within `stop_seconds`; then they are handed back.
    """

    def __init__(
        self, groups: list[list[str]], work: WorkFunction, tend: Callable[[], None], stop_seconds: float
    ) -> None:
        self._groups = groups
        self._work = work
        self._tend = tend
        self._stop_seconds = stop_seconds
        self._children: dict[int, list[str]] = {}
        self._restarts: list[tuple[float, list[str]]] = []
        self._stopping = False

    def run(self) -> None:
        """Until a signal, or until the process that started this one is gone."""
        parent = os.getppid()
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._stop)
        for queues in self._groups:
            self._start(queues)
        looked = time.monotonic()
        while not self._stopping and not parent_is_gone(parent):
            time.sleep(LOOK_SECONDS)
            self._reap()
            self._restart()
            if time.monotonic() - looked >= MAINTENANCE_SECONDS:
                looked = time.monotonic()
                with suppress(RedisError, OSError):  # out of reach, or the disk is full: the workers meet it too
                    self._tend()
        self._end()

    def _start(self, queues: list[str]) -> None:
        parent = os.getpid()
        child = os.fork()
        if child:
            self._children[child] = queues
            return
        try:
            end_with_parent(parent)
            signal.signal(signal.SIGTERM, signal.SIG_DFL)
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            self._work(queues)
        finally:
            os._exit(0)

    def _reap(self) -> None:
        while self._children:
            child, status = os.waitpid(-1, os.WNOHANG)
            if child == 0:
                return
            queues = self._children.pop(child, None)
            if queues is not None and not self._stopping:
                log.warning("worker %d (%s) ended with %d; starting another", child, ",".join(queues), status)
                self._restarts.append((time.monotonic() + RESTART_SECONDS, queues))

    def _restart(self) -> None:
        due = [restart for restart in self._restarts if restart[0] <= time.monotonic()]
        for restart in due:
            self._restarts.remove(restart)
            self._start(restart[1])

    def _stop(self, number: int, frame: object) -> None:  # noqa: ARG002  a signal handler's arguments
        self._stopping = True

    def _end(self) -> None:
        self._stopping = True
        for number, seconds in (
            (signal.SIGTERM, self._stop_seconds),
            (signal.SIGTERM, KILL_SECONDS),
            (signal.SIGKILL, KILL_SECONDS),
        ):
            for child in self._children:
                os.kill(child, number)
            deadline = time.monotonic() + seconds
            while self._children and time.monotonic() < deadline:
                time.sleep(LOOK_SECONDS / 2)
                self._reap()
