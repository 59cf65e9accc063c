"""A service on this machine for as long as a command needs it: the one that runs already, else one of its own."""

import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import httpx

from caesura.client.errors import Unreachable
from caesura.worker.parent_watch import parent_watch

START_SECONDS = 60.0
STOP_SECONDS = 30.0
LOOK_SECONDS = 0.1
ADDRESS = re.compile(r"^Caesura is at (\S+)$", re.MULTILINE)


@contextmanager
def local_service(port: int) -> Iterator[str]:
    """The URL of a service that answers; one that was started here ends with the context, or with this process.

    It is started as a person would start it, but what it logs is shown only if it does not start. Where the port
    is taken by something else, another is used. Raises `Unreachable`. Main thread only.
    """
    if port and _is_caesura(f"http://127.0.0.1:{port}"):
        yield f"http://127.0.0.1:{port}"
        return
    command = [
        sys.executable,
        "-m",
        "caesura.service.commands.cli",
        "serve",
        "--port",
        str(port if _is_free(port) else 0),
    ]
    with TemporaryDirectory(prefix="caesura-") as folder:
        log = Path(folder) / "log"
        with log.open("wb") as output:
            process = subprocess.Popen(  # noqa: S603  our own command and a number
                [*command, "--host", "127.0.0.1"],
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                start_new_session=True,  # Ctrl-C is for this process, which ends the other in order
                preexec_fn=parent_watch(signal.SIGTERM),  # noqa: PLW1509  one prctl call between fork and exec
            )
        try:
            yield _announced_address(log, process)
        finally:
            _end_process(process)


def _announced_address(log: Path, process: "subprocess.Popen[bytes]") -> str:
    """What it says once it answers."""
    deadline = time.monotonic() + START_SECONDS
    while process.poll() is None and time.monotonic() < deadline:
        said = ADDRESS.search(log.read_text(errors="replace"))
        if said:
            return said[1]
        time.sleep(LOOK_SECONDS)
    sys.stderr.write(log.read_text(errors="replace"))
    raise Unreachable("not-started", "The service did not start; what it said is above.")


def _end_process(process: "subprocess.Popen[bytes]") -> None:
    process.terminate()
    try:
        process.wait(STOP_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _is_caesura(url: str) -> bool:
    try:
        methods = httpx.get(f"{url}/v1/methods", trust_env=False).json()
    except (httpx.HTTPError, ValueError):
        return False
    return isinstance(methods, dict) and "algorithm" in methods


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
        return True
