"""Service and workers on hosts that share no disk: one Redis over TCP, one S3-compatible store, processes for hosts."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import httpx
import pytest
import redis

from caesura.worker.embedded_redis.server import find_program
from tests.installation import SLOWLY, take_npz
from tests.object_store import BUCKET, ObjectStore, free_port

WAIT_SECONDS = 90
PASSWORD = "0123456789abcdef"


class Host:
    """One process with a data folder that no other has."""

    def __init__(self, folder, environment, *command):
        self.data = folder
        environment = {**environment, "CAESURA_DATA_DIR": str(folder), "CAESURA_STOP_SECONDS": "1"}
        self.process = subprocess.Popen([sys.executable, "-m", *command], env=environment, start_new_session=True)

    def kill(self):
        """As a power cut: nothing of it goes on."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()

    def stop(self):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(20)
            except subprocess.TimeoutExpired:
                self.kill()

    def files(self):
        """What lies in its folder, but for compiled code."""
        found = (path for path in self.data.rglob("*") if path.is_file())
        return [path for path in found if path.suffix not in (".nbi", ".nbc")]


class Web(Host):
    """The web process on a host, and a client for it."""

    def __init__(self, folder, environment):
        port = free_port()
        super().__init__(folder, {**environment, "CAESURA_PORT": str(port)}, "service")
        self.http = httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60, trust_env=False)
        deadline = time.monotonic() + WAIT_SECONDS
        while time.monotonic() < deadline:
            assert self.process.poll() is None, "the web process ended"
            try:
                if self.http.get("/readyz").status_code == 200:
                    return
            except httpx.TransportError:
                time.sleep(0.05)
        raise TimeoutError("the web process did not answer")

    def stop(self):
        self.http.close()
        super().stop()

    def send(self, content, **parameters):
        """The status of a new segmentation; while the service says that it cannot, it is asked again when it said."""
        deadline = time.monotonic() + WAIT_SECONDS
        while time.monotonic() < deadline:
            answer = self.http.post("/v1/segmentations", params=parameters, content=content)
            if answer.status_code != 503:
                assert answer.status_code in (200, 202), answer.text
                return answer.json()
            time.sleep(int(answer.headers["Retry-After"]))
        raise TimeoutError(answer.text)

    def until(self, identifier, *statuses):
        """The status document once it has one of these."""
        deadline = time.monotonic() + WAIT_SECONDS
        while time.monotonic() < deadline:
            found = self.http.get(f"/v1/segmentations/{identifier}").json()
            if found["status"] in statuses:
                return found
            time.sleep(0.05)
        raise TimeoutError(found)

    def fetched(self, path):
        """What a GET answers in the end: some files are made at the first."""
        deadline = time.monotonic() + WAIT_SECONDS
        while time.monotonic() < deadline:
            answer = self.http.get(path)
            if answer.status_code != 202:
                assert answer.status_code == 200, answer.text
                return answer
            time.sleep(0.05)
        raise TimeoutError(path)


@pytest.fixture(scope="module")
def redis_tcp(tmp_path_factory):
    """A Redis server of its own, over TCP and with a password, as on another host."""
    port = free_port()
    options = ["--port", str(port), "--bind", "127.0.0.1", "--save", "", "--dir", str(tmp_path_factory.mktemp("redis"))]
    options += ["--requirepass", PASSWORD]
    process = subprocess.Popen([find_program(), *options], stdout=subprocess.DEVNULL, start_new_session=True)
    with redis.Redis(port=port, password=PASSWORD) as client:
        while True:
            try:
                client.ping()
                break
            except redis.ConnectionError:
                assert process.poll() is None
                time.sleep(0.02)
    yield f"redis://:{PASSWORD}@127.0.0.1:{port}/0"
    process.kill()
    process.wait()


@pytest.fixture(scope="module")
def store():
    """The object store."""
    store = ObjectStore.start()
    yield store
    store.stop()


@pytest.fixture(scope="module")
def environment(redis_tcp, store):
    """What every host is told: where Redis and the store are, and the one secret."""
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(("CAESURA_", "AWS_"))}
    return {
        **inherited,
        **store.environment,
        "REDIS_URL": redis_tcp,
        "CAESURA_STORE_URL": f"s3://{BUCKET}/caesura",
        "CAESURA_SECRET": "the same everywhere",
    }


@pytest.fixture(scope="module")
def hosts(environment, tmp_path_factory):
    """Two web processes and two hosts of workers, each with a folder of its own."""
    folder = tmp_path_factory.mktemp("hosts")
    hosts = {name: Host(folder / name, environment, "worker") for name in ("near", "far")}
    try:
        hosts |= {name: Web(folder / name, environment) for name in ("front", "back")}
        yield hosts
    finally:
        for host in hosts.values():
            host.stop()


def test_a_take_goes_through_hosts_that_share_no_disk(hosts, store):
    """Sent to one host, computed on another, everything that can be had of it fetched from a third; then forgotten."""
    front, back = hosts["front"], hosts["back"]
    content = take_npz()
    identifier = front.send(content, motions=2)["id"]
    status = back.until(identifier, "done", "failed")
    assert status["status"] == "done", status
    assert back.http.get(f"/v1/segmentations/{identifier}/result").json()["motions"] == 2
    for name in ("result.npz", "clips", "keyframes"):
        assert len(back.fetched(f"/v1/segmentations/{identifier}/{name}").content) > 100, name
    assert back.http.get(f"/v1/animations/{status['animation']}/file").content == content
    part = back.http.get(f"/v1/animations/{status['animation']}/file", headers={"Range": "bytes=100-199"})
    assert (part.status_code, part.content) == (206, content[100:200])
    again = front.send(content, motions=2)
    assert (again["id"], again["status"]) == (identifier, "done")
    recut = back.until(back.send(content, motions=1)["id"], "done", "failed")
    assert recut["status"] == "done"
    assert store.keys()
    assert store.half_written() == []
    assert all(host.files() == [] for host in hosts.values()), [host.files() for host in hosts.values()]
    assert back.http.delete(f"/v1/animations/{status['animation']}").status_code == 204
    assert store.keys() == []


def test_a_host_that_is_taken_away_loses_no_take(hosts):
    """Both hosts of workers have a long take; one is scaled away; the other does both."""
    front, near = hosts["front"], hosts["near"]
    takes = [take_npz(order=(0, 1) * 4, seconds=8.0, rings=60 + more) for more in range(2)]
    sent = [front.send(take, motions=2, **SLOWLY)["id"] for take in takes]
    for identifier in sent:
        front.until(identifier, "running", "done")
    near.stop()
    assert near.process.returncode == 0
    for identifier in sent:
        assert front.until(identifier, "done", "failed")["status"] == "done"


def test_a_store_that_is_out_of_reach_is_said_and_costs_nothing(hosts, store):
    """While the store is away an upload is refused with a status that means "later"; once back, all goes on."""
    front = hosts["front"]
    content = take_npz(order=(1, 0))
    store.stop()
    answer = front.http.post("/v1/segmentations", content=content)
    assert answer.status_code == 503, answer.text
    assert int(answer.headers["Retry-After"]) > 0
    assert answer.json()["code"] in {"not-ready", "storage-unavailable"}  # as readiness was looked at, or not yet
    assert front.files() == []
    back = ObjectStore.start(store.port)
    store.process = back.process
    done = front.until(front.send(content, motions=2)["id"], "done", "failed")
    assert done["status"] == "done"


def test_a_worker_host_tells_that_it_lives(hosts, environment):
    """`caesura worker --check`, as a liveness probe asks: 0 where a worker of this machine lives, else 1."""
    program = str(Path(sys.executable).parent / "caesura")
    check = subprocess.run([program, "worker", "--check"], env=environment, check=False, timeout=60)
    assert check.returncode == 0
    nobody = {**environment, "REDIS_URL": environment["REDIS_URL"].replace("/0", "/1")}
    assert subprocess.run([program, "worker", "--check"], env=nobody, check=False, timeout=60).returncode == 1
