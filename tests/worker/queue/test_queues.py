"""The queues: who comes when, and how many may wait."""

import pytest

from caesura.worker.queue.jobs import Jobs
from caesura.worker.queue.queues import QueueFull


def test_positions_count_from_the_front(idle, take):
    """The first in a queue has nobody before it."""
    waiting = [idle.submit(idle.upload(take)) for _ in range(3)]
    assert [idle.jobs.queues.position(record) for record in waiting] == [0, 1, 2]


def test_a_full_queue_takes_nothing_new(idle, take):
    """And says how many wait, and what to set; what waits already is answered as it is."""
    jobs = Jobs(idle.redis, max_queued=2)
    waiting = [jobs.submit(idle.wanted(idle.upload(take))) for _ in range(2)]
    with pytest.raises(QueueFull) as refused:
        jobs.submit(idle.wanted(idle.upload(take)))
    told = refused.value.problem()
    assert (told["code"], told["limit"], told["actual"], told["setting"]) == ("queue-full", 2, 2, "CAESURA_MAX_QUEUED")
    assert jobs.submit(waiting[0]) == waiting[0]
    jobs.cancel(waiting[0].id)
    assert jobs.submit(idle.wanted(idle.upload(take))).status == "queued"
