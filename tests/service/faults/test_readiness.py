"""Ready means that a warm worker takes jobs from each queue: whoever is sent here does not wait for one to start."""

import pytest

from caesura.worker.process.rq_worker import CaesuraWorker
from caesura.worker.process.worker_registry import IDLE_SECONDS, has_live_worker_here
from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import redis_keys
from caesura.worker.records.connection import connect
from tests.service.conftest import with_its_own_redis


@pytest.fixture(scope="module")
def lonely(checkout, tmp_path_factory):
    """A service whose workers come and go with the test."""
    with with_its_own_redis(checkout, tmp_path_factory.mktemp("lonely"), workers=False) as running:
        yield running


@pytest.fixture
def start(lonely):
    """Registers a worker of some queues, as one does before it waits for its first job."""
    with connect(lonely.redis_url) as client:

        def start(*queues):
            worker = CaesuraWorker(queues, client, Jobs(client))
            worker.register_birth()
            worker.heartbeat()
            return worker

        yield start
        client.flushall()


def readiness(lonely):
    """The status, and what is missing."""
    answer = lonely.http.get("/readyz")
    return answer.status_code, answer.json().get("detail")


def test_without_a_worker_it_is_not_ready_and_takes_work_all_the_same(lonely, take):
    """503 with the queues that nobody serves; what is posted waits for the worker."""
    status, detail = readiness(lonely)
    assert (status, detail) == (503, "No worker is ready to take jobs from analyse and cut.")
    assert lonely.http.post("/v1/segmentations", content=take(1701)).json()["status"] == "queued"


def test_each_queue_wants_a_worker(lonely, start):
    """One on `cut` alone does not do; with another on `analyse` it is ready; when that one ends it is not."""
    start("cut")
    assert readiness(lonely) == (503, "No worker is ready to take jobs from analyse.")
    other = start("analyse")
    assert readiness(lonely)[0] == 200
    other.register_death()
    assert readiness(lonely) == (503, "No worker is ready to take jobs from analyse.")


def test_a_worker_that_was_killed_is_missed(lonely, start):
    """Its sign of life is Redis's to end, whatever clocks say."""
    sign = redis_keys.worker_key(start("analyse", "cut").name)
    with connect(lonely.redis_url) as client:
        assert has_live_worker_here(client)
        assert 0 < client.ttl(sign) <= IDLE_SECONDS
        client.delete(sign)
        assert not has_live_worker_here(client)
    assert readiness(lonely)[0] == 503


def test_a_redis_that_lost_everything_hears_of_its_workers_again(lonely, start):
    """At their next sign of life, without a new start."""
    worker = start("analyse", "cut")
    with connect(lonely.redis_url) as client:
        client.flushall()
    assert readiness(lonely)[0] == 503
    worker.heartbeat()
    assert readiness(lonely)[0] == 200
