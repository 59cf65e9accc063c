"""A running service as the operating system sees it: its processes and the most memory each has used (Linux)."""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

LOOK_SECONDS = 0.2
PROC = Path("/proc")

ROLES = (
    ("caesura.service.process.web_process", "web"),
    ("valkey-server", "Redis"),
    ("redis-server", "Redis"),
    ("caesura serve", "supervisor"),
    ("caesura.service.commands.cli serve", "supervisor"),
)
"""What a command line says of a process; all others below the service are workers or their work-horses."""


class Running(NamedTuple):
    """A service that runs: its URL, its process id, and the socket of its embedded Redis."""

    url: str
    pid: int
    redis: Path


class Watch:
    """The largest resident size, in bytes, of every role below one process; read `peaks` after `stop`."""

    def __init__(self, root: int) -> None:
        self.root = root
        self.peaks: dict[str, int] = {}
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)
        self._thread.start()

    def stop(self) -> dict[str, int]:
        """The peaks, as seen so far."""
        self._over.set()
        self._thread.join()
        return self.peaks

    def _look(self) -> None:
        while not self._over.wait(LOOK_SECONDS):
            for pid in descendants(self.root):
                resident = _resident_peak(pid)
                if resident:
                    name = role(pid)
                    self.peaks[name] = max(self.peaks.get(name, 0), resident)


def descendants(root: int) -> list[int]:
    """A process and all below it."""
    children: dict[int, list[int]] = {}
    for stat in PROC.glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it has ended since
        children.setdefault(int(fields[1]), []).append(int(stat.parent.name))
    found, waiting = [], [root]
    while waiting:
        pid = waiting.pop()
        found.append(pid)
        waiting += children.get(pid, [])
    return found


@contextmanager
def service(**settings: str) -> Iterator[Running]:
    """A service of our own on a free port, with a data folder that is gone afterwards; `settings` as variables."""
    with TemporaryDirectory(prefix="caesura-bench-") as folder:
        environment = {name: value for name, value in os.environ.items() if name != "REDIS_URL"}
        process = subprocess.Popen(
            [sys.executable, "-m", "caesura.service.commands.cli", "serve", "--port", "0"],
            env=environment | {"CAESURA_DATA_DIR": folder} | settings,
            stdout=subprocess.PIPE,
            stderr=(Path(folder) / "log").open("wb"),
            text=True,
        )
        assert process.stdout is not None
        try:
            url = process.stdout.readline().split()[-1]
            yield Running(url, process.pid, Path(folder) / "redis" / "redis.sock")
        finally:
            process.send_signal(signal.SIGTERM)
            process.wait(60)


def _resident_peak(pid: int) -> int:
    try:
        status = (PROC / str(pid) / "status").read_text()
    except OSError:
        return 0
    return next((int(line.split()[1]) * 1024 for line in status.splitlines() if line.startswith("VmHWM")), 0)


def role(pid: int) -> str:
    """What a process does for the service, by its command line."""
    try:
        command = (PROC / str(pid) / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
    except OSError:
        return "worker"
    return next((name for part, name in ROLES if part in command), "worker")
