"""Everything on one machine: the embedded Redis, the workers and the web process, each a child that is watched.

Whatever ends this process ends them: a signal in order, a kill at once (worker/lifeline.py). A child that ends on
its own is started again. A job that was running when everything was killed is tried again at the next start.
"""

import http.client
import logging
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing

from service.settings import ServiceSettings
from worker.connection import connect
from worker.jobs import Jobs
from worker.layout import check_layout
from worker.lifeline import lifeline
from worker.redis_server import EmbeddedRedis
from worker.roster import forget_workers
from worker.watch import recover

log = logging.getLogger(__name__)

LOOK_SECONDS = 0.1
RESTART_SECONDS = 1.0
WEB_STOP_SECONDS = 5.0
WORKER_GRACE_SECONDS = 12.0
ANSWER_SECONDS = 1.0
BACKLOG = 512

OnReady = Callable[[str], None]


class _Child:
    """A process of ours that is meant to be there."""

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
            preexec_fn=lifeline(),  # noqa: PLW1509  one prctl call between fork and exec
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


def serve(settings: ServiceSettings, on_ready: OnReady | None = None) -> None:
    """Run until SIGINT or SIGTERM; call `on_ready` with the address once it answers. Main thread only."""
    stopping = _stop_signals()
    settings.data_dir.mkdir(parents=True, exist_ok=True, mode=0o700)
    with closing(_listen(settings.host, settings.port)) as listening:
        server = None if settings.redis_url else EmbeddedRedis(settings.redis_dir, settings.redis_server_bin)
        try:
            if server is not None:
                server.start()
                settings = settings.model_copy(update={"redis_url": server.url})
                _recover(settings)
            _watch(settings, listening, server, on_ready or _announce, stopping)
        finally:
            if server is not None:
                server.stop()


def _watch(
    settings: ServiceSettings,
    listening: socket.socket,
    server: EmbeddedRedis | None,
    on_ready: OnReady,
    stopping: list[int],
) -> None:
    environment = settings.environment()
    number = listening.fileno()
    web = _Child("the web process", ["service.web", "--socket", str(number)], environment, (number,))
    workers = _Child("the worker pool", ["worker"], environment)
    ready = False
    try:
        while not stopping:
            time.sleep(LOOK_SECONDS)
            if server is not None and server.ended():
                log.warning("the embedded Redis ended; starting it again")
                server.start()
            web.look()
            workers.look()
            if not ready and _answers(listening):
                ready = True
                on_ready(_address(listening))
                if settings.keys_needed:
                    log.info("Every call needs a key here; `caesura keys add NAME` makes one")
    finally:
        web.process.terminate()
        workers.process.terminate()
        web.wait(WEB_STOP_SECONDS)
        workers.wait(settings.stop_seconds + WORKER_GRACE_SECONDS)


def _recover(settings: ServiceSettings) -> None:
    """Our own server holds what was left at the last end, and nobody can be working on it now."""
    client = connect(settings.redis_location)
    check_layout(client)
    forget_workers(client)
    lost = recover(Jobs.open(settings))
    if lost:
        log.warning("%d jobs were running at the last end; they are tried again", lost)


def _stop_signals() -> list[int]:
    """A list that gets the signal which asks to stop. A second one does not hurry: the children are being ended."""
    received: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: received.append(number))
    return received


def _listen(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    return socket.create_server((host, port), family=family, backlog=BACKLOG)


def _address(listening: socket.socket) -> str:
    host, port = listening.getsockname()[:2]
    host = _reachable(host)
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def _answers(listening: socket.socket) -> bool:
    """Whether the web process is up. To connect alone tells nothing: the socket is ours."""
    host, port = listening.getsockname()[:2]
    connection = http.client.HTTPConnection(_reachable(host), port, timeout=ANSWER_SECONDS)
    try:
        connection.request("GET", "/healthz")
        return connection.getresponse().status == http.HTTPStatus.OK
    except (OSError, http.client.HTTPException):
        return False
    finally:
        connection.close()


def _reachable(host: str) -> str:
    """An address to connect to, where the one listened on is any."""
    return {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)  # noqa: S104  not bound here


def _announce(address: str) -> None:
    sys.stdout.write(f"Caesura is at {address}\n")
    sys.stdout.flush()
