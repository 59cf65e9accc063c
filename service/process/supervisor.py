"""Everything on one machine: the embedded Redis, the workers and the web process, each a child that is watched.

Whatever ends this process ends them: a signal in order, a kill at once (worker/parent_watch.py). A child that ends on
its own is started again. A job that was running when everything was killed is tried again at the next start.
"""

import logging
import signal
import socket
import sys
import time
from collections.abc import Callable
from contextlib import closing

from caesura.service.http.listening_socket import address_of_socket, is_answering, open_listening_socket
from caesura.service.process.child_process import ChildProcess
from caesura.service.settings import ServiceSettings
from caesura.worker.embedded_redis.server import EmbeddedRedis
from caesura.worker.private_folder import make_private
from caesura.worker.process.worker_registry import remove_dead_workers
from caesura.worker.queue.jobs import Jobs
from caesura.worker.queue.orphaned_jobs import retry_jobs_after_restart
from caesura.worker.records.connection import connect, tolerate_full_disk
from caesura.worker.records.storage_version import check_layout

log = logging.getLogger(__name__)

LOOK_SECONDS = 0.1
WEB_STOP_SECONDS = 5.0
WORKER_GRACE_SECONDS = 12.0

OnReady = Callable[[str], None]


def run_supervisor(settings: ServiceSettings, on_ready: OnReady | None = None) -> None:
    """Run until SIGINT or SIGTERM; call `on_ready` with the address once it answers. Main thread only."""
    stopping = _stop_signals()
    make_private(settings.data_dir)
    with closing(open_listening_socket(settings.host, settings.port)) as listening:
        server = None if settings.redis_url else EmbeddedRedis(settings.redis_dir, settings.redis_server_bin)
        try:
            if server is not None:
                server.start()
                settings = settings.model_copy(update={"redis_url": server.url})
                with tolerate_full_disk():  # the workers find what is lost once it has room
                    _resume_jobs(settings)
            _watch_children(settings, listening, server, on_ready or _print_address, stopping)
        finally:
            if server is not None:
                server.stop()


def _watch_children(
    settings: ServiceSettings,
    listening: socket.socket,
    server: EmbeddedRedis | None,
    on_ready: OnReady,
    stopping: list[int],
) -> None:
    environment = settings.environment()
    number = listening.fileno()
    web = ChildProcess(
        "the web process", ["caesura.service.process.web_process", "--socket", str(number)], environment, (number,)
    )
    workers = ChildProcess("the worker pool", ["caesura.worker"], environment)
    ready = False
    try:
        while not stopping:
            time.sleep(LOOK_SECONDS)
            if server is not None and server.ended():
                log.warning("the embedded Redis ended; starting it again")
                server.start()
            web.look()
            workers.look()
            if not ready and is_answering(listening):
                ready = True
                on_ready(address_of_socket(listening))
                if settings.keys_needed:
                    log.info("Every call needs an API key; `caesura keys add NAME` makes one")
    finally:
        web.process.terminate()
        workers.process.terminate()
        web.wait(WEB_STOP_SECONDS)
        workers.wait(settings.stop_seconds + WORKER_GRACE_SECONDS)


def _resume_jobs(settings: ServiceSettings) -> None:
    """Our own server holds what was left at the last end, and nobody can be working on it now."""
    client = connect(settings.redis_location)
    check_layout(client)
    remove_dead_workers(client)
    lost = retry_jobs_after_restart(Jobs.open(settings))
    if lost:
        log.warning("%d jobs were running when the service ended; they are tried again", lost)


def _stop_signals() -> list[int]:
    """A list that gets the signal which asks to stop. A second one does not hurry: the children are being ended."""
    received: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: received.append(number))
    return received


def _print_address(address: str) -> None:
    sys.stdout.write(f"Caesura is at {address}\n")
    sys.stdout.flush()
