"""Ready means that a warm worker takes jobs from each queue: whoever is sent here does not wait for one to start."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.service.conftest import with_its_own_redis
from worker import keys
from worker.connection import connect
from worker.horses import CaesuraWorker
from worker.jobs import Jobs
from worker.roster import IDLE_SECONDS, alive_here, unserved

WORKER = """
import sys
from worker.connection import connect
from worker.horses import CaesuraWorker
from worker.jobs import Jobs
from worker.settings import WorkerSettings
settings = WorkerSettings()
CaesuraWorker(sys.argv[1:], connect(settings.redis_location), Jobs.open(settings)).work()
"""


@pytest.fixture(scope="module")
def lonely(checkout, tmp_path_factory):
    """A service whose workers come and go with the test."""
    with with_its_own_redis(checkout, tmp_path_factory.mktemp("lonely"), workers=False) as running:
        yield running


@pytest.fixture
def start(lonely):
    """Starts a worker of some queues, and waits until it has given a sign of life."""
    started = []

    def start(*queues):
        environment = {**os.environ, "REDIS_URL": lonely.redis_url}
        started.append(subprocess.Popen([sys.executable, "-c", WORKER, *queues], env=environment))
        until(lambda: set(queues).isdisjoint(unserved(connect(lonely.redis_url))))
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.wait()
    connect(lonely.redis_url).flushall()


def until(holds):
    deadline = time.monotonic() + 30
    while not holds():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def readiness(lonely):
    """The status, and what is missing."""
    answer = lonely.http.get("/readyz")
    return answer.status_code, answer.json().get("detail")


def test_without_a_worker_it_is_not_ready_and_takes_work_all_the_same(lonely, take):
    """503 with the queues that nobody serves; what is posted waits for the worker."""
    status, detail = readiness(lonely)
    assert (status, detail) == (503, "No worker is ready to take jobs from analyse and cut.")
    assert lonely.http.post("/v1/segmentations", content=take(1701)).json()["status"] == "queued"


def test_each_queue_wants_a_worker_of_its_own_or_shared(lonely, start):
    """One on `cut` alone does not do; with another on `analyse` it is ready; when that is told to end it is not."""
    start("cut")
    assert readiness(lonely) == (503, "No worker is ready to take jobs from analyse.")
    other = start("analyse")
    assert readiness(lonely)[0] == 200
    other.send_signal(signal.SIGTERM)
    other.wait(20)
    assert readiness(lonely)[0] == 503


def test_a_worker_that_was_killed_is_missed(lonely, start):
    """Its sign of life is Redis's to end, whatever clocks say."""
    start("analyse", "cut").kill()
    with connect(lonely.redis_url) as client:
        (sign,) = client.keys(keys.worker_key("*"))
        assert 0 < client.ttl(sign) <= IDLE_SECONDS
        client.pexpire(sign, 1)
        until(lambda: not client.exists(sign))
        assert not alive_here(client)
    assert readiness(lonely)[0] == 503


def test_a_redis_that_lost_everything_hears_of_its_workers_again(lonely):
    """At their next sign of life, without a new start."""
    with connect(lonely.redis_url) as client:
        worker = CaesuraWorker(["analyse", "cut"], client, Jobs(client))
        client.flushall()
        worker.heartbeat()
        assert readiness(lonely)[0] == 200
        client.flushall()
