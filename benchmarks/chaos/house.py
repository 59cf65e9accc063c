"""A service that is killed piece by piece: `caesura serve` over one data folder, started again wherever it ends.

Whoever is killed gets SIGKILL, with no time to say anything. The service's own parts come back by themselves (its
supervisor sees to that); where the supervisor is killed, we start the same command over the same folder.
"""

import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import httpx

from benchmarks.chaos.clock import JumpingClock
from benchmarks.timing.processes import PROC
from caesura.worker.queue.jobs import Jobs
from caesura.worker.settings import WorkerSettings
from caesura.worker.store.blobs import Blobs

READY_SECONDS = 300  # the first start compiles the kernels
STOP_SECONDS = 60
MIN_FREE_BYTES = 2**24
SECRET = "the same ids in every run"


class House:
    """One installation. `log` is what it said, all lives together."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.settings = WorkerSettings(data_dir=folder, redis_url="", secret=SECRET)
        self.url = f"http://127.0.0.1:{_free_port()}"
        self.clock = JumpingClock(folder)
        self.lives = 0
        self._process: subprocess.Popen[bytes] | None = None

    def keep_up(self) -> None:
        """Start it where it does not run."""
        if self._process is not None and self._process.poll() is None:
            return
        kept = {name: value for name, value in os.environ.items() if name != "REDIS_URL"}
        environment = {
            **kept,
            "CAESURA_DATA_DIR": str(self.folder),
            "CAESURA_SECRET": SECRET,
            "CAESURA_PRIVATE_NETWORKS": "127.0.0.1",
            "CAESURA_MIN_FREE_BYTES": str(MIN_FREE_BYTES),
            **self.clock.environment,
        }
        with (self.folder / "log").open("ab") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "caesura.service.commands.cli", "serve", "--port", self.url.rpartition(":")[2]],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )
        self.lives += 1

    def until_ready(self) -> None:
        """Until it says that it can work; raises TimeoutError."""
        deadline = time.monotonic() + READY_SECONDS
        while time.monotonic() < deadline:
            self.keep_up()
            with suppress(httpx.TransportError):
                if httpx.get(f"{self.url}/readyz", trust_env=False).status_code == httpx.codes.OK:
                    return
            time.sleep(0.1)
        raise TimeoutError("the service did not come back")

    def parts(self) -> dict[str, list[int]]:
        """The processes that run now, by what they are."""
        assert self._process is not None
        found: dict[str, list[int]] = {"supervisor": [self._process.pid]}
        for child in _children(self._process.pid):
            said = _command(child)
            name = next((name for word, name in WORDS.items() if word in said), "")
            found.setdefault(name, []).append(child)
        found["worker"] = [worker for pool in found.get("pool", []) for worker in _children(pool)]
        found["work-horse"] = [horse for worker in found["worker"] for horse in _children(worker)]
        return found

    def stop(self) -> list[int]:
        """End it in order, as a operator would; which processes are still there then."""
        if self._process is not None:
            self._process.send_signal(signal.SIGTERM)
            self._process.wait(STOP_SECONDS)
        return self.left()

    def left(self) -> list[int]:
        """Processes of this installation, wherever they hang: those that were told its data folder."""
        mark = f"CAESURA_DATA_DIR={self.folder}\0".encode()
        found = []
        for environ in PROC.glob("[0-9]*/environ"):
            with suppress(OSError):
                if mark in environ.read_bytes() + b"\0" and int(environ.parent.name) != os.getpid():
                    found.append(int(environ.parent.name))
        return found

    def jobs(self) -> Jobs:
        """Its queues and records, looked at from outside."""
        return Jobs.open(self.settings)

    def blobs(self) -> Blobs:
        """Its store."""
        return Blobs.open(self.settings.store_location, self.settings.scratch_dir)


WORDS = {
    "caesura.service.process.web_process": "web",
    "-m caesura.worker": "pool",
    "valkey-server": "Redis",
    "redis-server": "Redis",
}


def _children(pid: int) -> list[int]:
    found: list[int] = []
    for children in (PROC / str(pid) / "task").glob("*/children"):
        with suppress(OSError):
            found += map(int, children.read_text().split())
    return found


def _command(pid: int) -> str:
    try:
        return (PROC / str(pid) / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
    except OSError:
        return ""


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
