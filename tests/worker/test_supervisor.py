"""`caesura run_supervisor`: one process that starts everything, and takes everything with it however it ends."""

import json
import os
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

from caesura.worker.settings import WorkerSettings
from tests.installation import SLOWLY, Installation, alive, descendants

SERVE = """
from caesura.service.settings import ServiceSettings
from caesura.service.process.supervisor import run_supervisor
import sys
run_supervisor(ServiceSettings(port=0), on_ready=lambda address: print(address, flush=True))
assert "numpy" not in sys.modules
"""


class Serving:
    """The supervisor in a process of its own, and all processes below it."""

    def __init__(self, data_dir):
        environment = {name: value for name, value in os.environ.items() if name != "REDIS_URL"}
        environment |= {"CAESURA_DATA_DIR": str(data_dir), "CAESURA_STOP_SECONDS": "0.5"}
        self.process = subprocess.Popen(
            [sys.executable, "-c", SERVE], env=environment, stdout=subprocess.PIPE, text=True, start_new_session=True
        )
        self.address = self.process.stdout.readline().strip()
        self.place = Installation.at(WorkerSettings(data_dir=data_dir, redis_url=""))

    def tree(self):
        return [self.process.pid, *(pid for _, pid in descendants(self.process.pid))]

    def named(self, word):
        """The process below whose command has this word."""
        found = [pid for pid in self.tree() if word in command(pid)]
        assert found, word
        return found[0]

    def end(self, number):
        """Send a signal; the exit status, and which processes are left a moment later."""
        tree = self.tree()
        self.place.redis.close()
        self.process.send_signal(number)
        status = self.process.wait(20)
        self.process.stdout.close()
        deadline = time.monotonic() + 5
        while any(map(alive, tree)) and time.monotonic() < deadline:
            time.sleep(0.02)
        return status, [command(pid) for pid in tree if alive(pid)]


def command(pid):
    """What a process was started as; empty where it is gone."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode()
    except FileNotFoundError:
        return ""


@pytest.fixture
def start(tmp_path_factory):
    """Starts the supervisor over one data folder; what a test leaves behind is killed."""
    folder = tmp_path_factory.mktemp("run_supervisor")
    started = []

    def begin():
        started.append(Serving(folder))
        return started[-1]

    yield begin
    for serving in started:
        if serving.process.poll() is None:
            serving.end(signal.SIGKILL)


def health(address):
    with urllib.request.urlopen(f"{address}/healthz", timeout=5) as answer:
        return answer.status


def test_however_it_ends_no_orphan_and_no_lost_job(start, long_take):
    """SIGTERM hands a long job back, uncounted; SIGKILL loses an attempt; the next start finishes the job."""
    serving = start()
    assert health(serving.address) == 200
    record = serving.place.submit(serving.place.upload(long_take), **SLOWLY)
    serving.place.begun(record.id)
    assert serving.end(signal.SIGTERM) == (0, [])
    serving = start()
    assert serving.place.begun(record.id).attempt == 1
    assert serving.end(signal.SIGKILL) == (-signal.SIGKILL, [])
    serving = start()
    done = serving.place.ended(record.id)
    assert (done.status, done.attempt) == ("done", 2)
    assert serving.end(signal.SIGTERM) == (0, [])


def test_children_that_die_are_started_again(start, take):
    """Without its Redis, its web process or its workers, the service comes back, and a new take is segmented."""
    serving = start()
    done = serving.place.ended(serving.place.submit(serving.place.upload(take)).id)
    for word in ("valkey-server", "caesura.service.process.web_process", "-m caesura.worker"):
        os.kill(serving.named(word), signal.SIGKILL)
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        try:
            assert health(serving.address) == 200
            second = serving.place.ended(serving.place.submit(serving.place.upload(take)).id)
            break
        except (OSError, ConnectionError):
            time.sleep(0.1)
    assert second.status == "done"
    assert serving.place.records.segmentations.one(done.id) == done
    assert json.loads(serving.place.records.segmentations.result(done.id)[0])["id"] == done.id
    assert serving.end(signal.SIGINT) == (0, [])
