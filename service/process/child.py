"""A process of ours that is meant to be there: it ends with us, and is started again where it ends on its own."""

import logging
import os
import subprocess
import sys
import time

from caesura.worker.parent_watch import parent_watch

log = logging.getLogger(__name__)

RESTART_SECONDS = 1.0


class ChildProcess:
    """`python -m` with some arguments; `keep` are the files that it inherits."""

    def __init__(
        self, name: str, arguments: list[str], environment: dict[str, str], keep: tuple[int, ...] = ()
    ) -> None:
        self.name = name
        self._command = [sys.executable, "-m", *arguments]
        self._environment = {**os.environ, **environment}
        self._keep = keep
        self._ended = 0.0
        self.process = self._start()

    def _start(self) -> "subprocess.Popen[bytes]":
        return subprocess.Popen(  # noqa: S603  our own words, no shell
            self._command,
            env=self._environment,
            stdin=subprocess.DEVNULL,
            pass_fds=self._keep,
            start_new_session=True,  # Ctrl-C is for us: we end the children in order
            preexec_fn=parent_watch(),  # noqa: PLW1509  one prctl call between fork and exec
        )

    def look(self) -> None:
        """Start it again a moment after it ended."""
        if self.process.poll() is None:
            return
        if not self._ended:
            log.warning("%s ended with %s; starting it again", self.name, self.process.returncode)
            self._ended = time.monotonic()
        elif time.monotonic() - self._ended > RESTART_SECONDS:
            self._ended = 0.0
            self.process = self._start()

    def wait(self, seconds: float) -> None:
        """Until it has ended, by SIGKILL if it must be."""
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
