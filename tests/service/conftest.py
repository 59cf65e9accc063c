"""The real service: uvicorn in a process of its own, a real Redis, real workers; and small takes to send it."""

import io
import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx
import numpy as np
import pytest

from caesura.worker.embedded_redis.server import EmbeddedRedis
from tests.animations import performing_bar

START_SECONDS = 200  # ready is a warm worker, and a fresh checkout compiles the kernels first
UPLOAD_LIMIT = 8_000_000


@dataclass(frozen=True)
class Service:
    """A running service: its address, a client, its data folder, its Redis, and the process id of its web server."""

    url: str
    http: httpx.Client
    data: Path
    redis_url: str
    pid: int

    def spooled(self):
        """What uploads have left in the spool."""
        return list((self.data / "scratch" / "spool").glob("*"))

    def status(self, name):
        """A line of the web process's /proc status, in bytes."""
        for line in Path(f"/proc/{self.pid}/status").read_text().splitlines():
            if line.startswith(f"{name}:"):
                return int(line.split()[1]) * 1024
        raise LookupError(name)


@contextmanager
def _process(*command, env):
    """A child in a group of its own, ended by the group it made."""
    process = subprocess.Popen(command, env=env, start_new_session=True)
    try:
        yield process
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGTERM)
        try:
            process.wait(15)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def _free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextmanager
def serve(checkout, data, redis_url, workers, ready=True, **settings):
    """A web process, with workers beside it or without, until the block ends; `settings` as CAESURA_… variables.

    Not `ready`, or without workers: it can never be, so it is waited for until it answers at all.
    """
    port = _free_port()
    env = {
        **{name: value for name, value in os.environ.items() if not name.startswith("CAESURA_")},
        "REDIS_URL": redis_url,
        "CAESURA_DATA_DIR": str(data),
        "CAESURA_PORT": str(port),
        "CAESURA_MAX_UPLOAD_BYTES": str(UPLOAD_LIMIT),
        "PYTHONPATH": str(checkout),
        **{f"CAESURA_{name.upper()}": str(value) for name, value in settings.items()},
    }
    url = f"http://127.0.0.1:{port}"
    with ExitStack() as stack:
        web = stack.enter_context(_process(sys.executable, "-m", "caesura.service", env=env))
        http = stack.enter_context(httpx.Client(base_url=url, timeout=60))
        if workers:
            stack.enter_context(_process(sys.executable, "-m", "caesura.worker", env=env))
        _until(web, http, "/readyz" if ready and workers else "/healthz")
        yield Service(url, http, data, redis_url, web.pid)


def _until(web, http, path):
    deadline = time.monotonic() + START_SECONDS
    while time.monotonic() < deadline:
        assert web.poll() is None, "the web process ended"
        try:
            if http.get(path).status_code == 200:
                return
        except httpx.TransportError:
            pass
        time.sleep(0.05)
    raise TimeoutError("the web process did not answer")


@contextmanager
def with_its_own_redis(checkout, folder, workers, **settings):
    """A service and its queue, in a folder of their own."""
    redis = EmbeddedRedis(folder / "redis")
    redis.start()
    try:
        with serve(checkout, folder, redis.url, workers=workers, **settings) as running:
            yield running
    finally:
        redis.stop()


@contextmanager
def half_upload(running):
    """The connection of an upload of 5 MB, of which the service has begun to keep the first 2."""
    host, port = running.url.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port)), timeout=20) as client:
        client.sendall(b"POST /v1/animations HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5000000\r\n\r\nglTF")
        client.sendall(bytes(2_000_000))
        deadline = time.monotonic() + 20
        while not running.spooled():
            assert time.monotonic() < deadline
            time.sleep(0.02)
        yield client


@pytest.fixture(scope="session")
def service(checkout, tmp_path_factory):
    """The whole service, shared by all tests: each sends a take of its own."""
    folder = tmp_path_factory.mktemp("service")
    with with_its_own_redis(
        checkout, folder, workers=True, private_networks="127.0.0.1", upload_hosts="127.0.0.1"
    ) as running:
        yield running


@pytest.fixture(scope="session")
def idle(checkout, tmp_path_factory):
    """A service without workers: whatever it is asked stays queued."""
    with with_its_own_redis(checkout, tmp_path_factory.mktemp("idle"), workers=False) as running:
        yield running


def npz(**arrays):
    """Arrays as the bytes of an NPZ."""
    out = io.BytesIO()
    np.savez(out, **arrays)
    return out.getvalue()


@pytest.fixture(scope="session")
def take():
    """Makes the bytes of small takes, a different one for every seed; four segments of three motions, 240 frames."""
    animation = performing_bar((0, 1, 0, 2), seconds=2.0, rings=12).animation
    vertices = np.array(animation.vertices(0, animation.frames))

    def make(seed):
        shift = np.float32([seed, 0, 0])
        return npz(vertices=vertices + shift, triangles=animation.triangles, frame_rate=np.float64(30))

    return make
