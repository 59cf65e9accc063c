"""Nothing is stuck: what nobody works on is found and tried again, and nothing else is."""

import time

from caesura.worker.queue.job_problems import LOST
from caesura.worker.queue.jobs import retry_delay_seconds
from caesura.worker.queue.orphaned_jobs import OrphanedJobWatch, retry_jobs_after_restart
from caesura.worker.records import redis_keys
from caesura.worker.records.attempts import LEASE_SECONDS


def test_a_running_job_without_a_sign_of_life_is_tried_again(idle, take):
    """Not at first sight, which may be a clock that jumped, but at the second."""
    watch, record = OrphanedJobWatch(idle.jobs), idle.submit(idle.upload(take))
    running = idle.records.attempts.begin(record.id, record.token)
    assert 0 < idle.redis.ttl(redis_keys.lease_key(running.token)) <= LEASE_SECONDS
    assert watch.look() == 0
    idle.redis.delete(redis_keys.lease_key(running.token))
    assert [watch.look(), watch.look(), watch.look()] == [0, 1, 0]
    assert idle.records.segmentations.one(record.id).attempt == 2


def test_a_job_that_fell_out_of_its_queue_is_queued_again(idle, take):
    """A worker that dies between the queue and its first word takes the job with it; it is found missing."""
    watch, record = OrphanedJobWatch(idle.jobs), idle.submit(idle.upload(take))
    idle.redis.delete("rq:queue:analyse")
    assert [watch.look(), watch.look()] == [0, 1]
    assert idle.jobs.queues.position(idle.records.segmentations.one(record.id)) == 0


def test_after_a_fault_of_the_infrastructure_it_pauses(idle, take):
    """It is queued but has no place in the queue, nobody takes it for lost, and when its pause is over it gets one."""
    watch, record = OrphanedJobWatch(idle.jobs), idle.submit(idle.upload(take))
    idle.records.attempts.begin(record.id, record.token)
    idle.redis.delete("rq:queue:analyse")  # its worker had taken it from there
    paused = idle.jobs.retry(record.id, record.token, LOST, pause=True)
    assert (paused.status, paused.attempt, idle.jobs.queues.position(paused)) == ("queued", 2, None)
    assert 0 < paused.due - time.time() <= retry_delay_seconds(1)
    assert [watch.look(), watch.look()] == [0, 0]
    assert idle.jobs.queues.position(paused) is None
    idle.records.segmentations.change(record.id, lambda r: r.with_changes(due=time.time() - 1))
    assert watch.look() == 0
    resumed = idle.records.segmentations.one(record.id)
    assert (resumed.attempt, resumed.token, resumed.due) == (2, paused.token, 0)
    assert idle.jobs.queues.position(resumed) == 0


def test_a_pause_does_not_outlast_a_clock_that_was_put_back(idle, take):
    """What is due in an hour was not set by this clock."""
    watch, record = OrphanedJobWatch(idle.jobs), idle.submit(idle.upload(take))
    paused = idle.jobs.retry(record.id, record.token, LOST, pause=True)
    idle.records.segmentations.change(record.id, lambda r: r.with_changes(due=time.time() + 3600))
    watch.look()
    assert idle.records.segmentations.one(paused.id).due == 0


def test_pauses_grow_and_are_bounded():
    """Two seconds, eight, half a minute, never more than a minute."""
    assert [retry_delay_seconds(attempt) for attempt in (1, 2, 3, 4, 9)] == [2, 8, 32, 60, 60]


def test_a_clock_that_jumps_loses_no_attempt(idle, take):
    """A lease is Redis's to end: what our clocks say of a record, a year ago or ahead, makes nobody lost."""
    watch, record = OrphanedJobWatch(idle.jobs), idle.submit(idle.upload(take))
    running = idle.records.attempts.begin(record.id, record.token)
    for jumped in (running.updated - 3e7, running.updated + 3e7):
        key = redis_keys.segmentation_key(record.id)
        idle.redis.set(key, running.with_changes(updated=jumped, created=jumped).model_dump_json())
        assert [watch.look() for _ in range(3)] == [0, 0, 0]
    assert 0 < idle.redis.ttl(redis_keys.lease_key(record.token)) <= LEASE_SECONDS
    idle.redis.delete(redis_keys.lease_key(record.token))
    assert [watch.look() for _ in range(2)] == [0, 1]


def test_when_a_server_starts_whatever_ran_is_lost_at_once(idle, take):
    """A lease may still run, but no worker can be alive. What waits stays in its place, and no pause is waited for."""
    running, waiting, pausing = (idle.submit(idle.upload(take)) for _ in range(3))
    idle.records.attempts.begin(running.id, running.token)
    idle.jobs.retry(pausing.id, pausing.token, LOST, pause=True)
    assert retry_jobs_after_restart(idle.jobs) == 1
    after = [idle.records.segmentations.one(record.id) for record in (running, waiting, pausing)]
    assert [(record.status, record.attempt) for record in after] == [("queued", 2), ("queued", 1), ("queued", 2)]
    assert after[1].token == waiting.token
    assert None not in [idle.jobs.queues.position(record) for record in after]
