"""The state machine: one attempt at a time writes, and nothing is lost, stuck or done twice."""

import os
import signal
import time
from pathlib import Path

import pytest

from tests.installation import SLOWLY, descendants
from worker import keys
from worker.horse import WORKING
from worker.jobs import QUEUES, Jobs, QueueFull, pause_seconds, worker_problem
from worker.records.attempts import LEASE_SECONDS

LOST = worker_problem("worker-lost", "Lost.")
RESULT = {"energy": b"", "labels": b""}


def test_the_same_submission_is_one_job(idle, take):
    """Submitted again while it waits, the record is answered as it is, and the queue stays as long as it was."""
    animation = idle.upload(take)
    first = idle.submit(animation)
    assert idle.submit(animation) == first
    assert idle.jobs.depths() == {"analyse": 1, "cut": 0}


def test_positions_count_from_the_front(idle, take):
    """The first in a queue has nobody before it."""
    waiting = [idle.submit(idle.upload(take)) for _ in range(3)]
    assert [idle.jobs.position(record) for record in waiting] == [0, 1, 2]


def test_a_queued_job_can_be_cancelled_and_comes_back(idle, take):
    """Cancelled, it leaves the queue; posted again, it is a new attempt."""
    animation = idle.upload(take)
    first = idle.submit(animation)
    assert idle.jobs.cancel(first.id).status == "cancelled"
    assert idle.jobs.depths() == {"analyse": 0, "cut": 0}
    assert idle.jobs.cancel(first.id) is None
    second = idle.submit(animation)
    assert second.status == "queued"
    assert second.token != first.token


def test_an_attempt_begins_once(idle, take):
    """Were its job delivered twice, the second delivery does nothing."""
    record = idle.submit(idle.upload(take))
    assert idle.records.attempts.begin(record.id, record.token).status == "running"
    assert idle.records.attempts.begin(record.id, record.token) is None


def test_a_late_attempt_writes_nothing(idle, take):
    """Once another attempt has begun, the old one can tell no progress, no result and no failure."""
    record = idle.submit(idle.upload(take))
    old = idle.records.attempts.begin(record.id, record.token)
    newer = idle.jobs.again(old.id, old.token, LOST)
    assert (newer.status, newer.attempt) == ("queued", 2)
    assert idle.records.attempts.change(old.id, old.token, stage="late") is None
    assert not idle.records.attempts.finish(old.id, old.token, "late", RESULT)
    assert not idle.records.attempts.fail(old.id, old.token, LOST)
    assert idle.jobs.again(old.id, old.token, LOST) is None
    assert idle.records.segmentations.one(old.id) == newer
    assert idle.records.segmentations.result(old.id) == (None, None, None)


def test_attempts_are_bounded_and_then_posting_again_starts_anew(idle, take):
    """Lost for the third time it fails with the reason; that was not the file's fault, so it may be posted again."""
    animation = idle.upload(take)
    record = idle.submit(animation)
    for _ in range(idle.settings.attempts):
        record = idle.jobs.again(record.id, record.token, LOST)
    assert (record.status, record.problem) == ("failed", LOST)
    fresh = idle.submit(animation)
    assert (fresh.status, fresh.attempt, fresh.problem) == ("queued", 1, None)


def test_a_running_job_without_a_sign_of_life_is_tried_again(idle, take):
    """Not at first sight, which may be a clock that jumped, but at the second."""
    record = idle.submit(idle.upload(take))
    running = idle.records.attempts.begin(record.id, record.token)
    assert 0 < idle.redis.ttl(keys.lease_key(running.token)) <= LEASE_SECONDS
    assert idle.jobs.reconcile() == 0
    idle.redis.delete(keys.lease_key(running.token))
    assert [idle.jobs.reconcile(), idle.jobs.reconcile(), idle.jobs.reconcile()] == [0, 1, 0]
    assert idle.records.segmentations.one(record.id).attempt == 2


def test_a_job_that_fell_out_of_its_queue_is_queued_again(idle, take):
    """A worker that dies between the queue and its first word takes the job with it; it is found missing."""
    record = idle.submit(idle.upload(take))
    idle.redis.delete("rq:queue:analyse")
    assert [idle.jobs.reconcile(), idle.jobs.reconcile()] == [0, 1]
    assert idle.jobs.position(idle.records.segmentations.one(record.id)) == 0


def test_after_a_fault_of_the_infrastructure_it_pauses(idle, take):
    """It is queued but has no place in the queue, nobody takes it for lost, and when its pause is over it gets one."""
    record = idle.submit(idle.upload(take))
    idle.records.attempts.begin(record.id, record.token)
    idle.redis.delete("rq:queue:analyse")  # its worker had taken it from there
    paused = idle.jobs.again(record.id, record.token, LOST, pause=True)
    assert (paused.status, paused.attempt, idle.jobs.position(paused)) == ("queued", 2, None)
    assert 0 < paused.due - time.time() <= pause_seconds(1)
    assert [idle.jobs.reconcile(), idle.jobs.reconcile()] == [0, 0]
    assert idle.jobs.position(paused) is None
    idle.records.segmentations.change(record.id, lambda r: r.with_(due=time.time() - 1))
    assert idle.jobs.reconcile() == 0
    resumed = idle.records.segmentations.one(record.id)
    assert (resumed.attempt, resumed.token, resumed.due) == (2, paused.token, 0)
    assert idle.jobs.position(resumed) == 0


def test_a_pause_does_not_outlast_a_clock_that_was_put_back(idle, take):
    """What is due in an hour was not set by this clock."""
    record = idle.submit(idle.upload(take))
    paused = idle.jobs.again(record.id, record.token, LOST, pause=True)
    idle.records.segmentations.change(record.id, lambda r: r.with_(due=time.time() + 3600))
    idle.jobs.reconcile()
    assert idle.records.segmentations.one(paused.id).due == 0


def test_pauses_grow_and_are_bounded():
    """Two seconds, eight, half a minute, never more than a minute."""
    assert [pause_seconds(attempt) for attempt in (1, 2, 3, 4, 9)] == [2, 8, 32, 60, 60]


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


def test_a_deleted_segmentation_leaves_nothing(idle, take):
    """No key of it stays, and its job is gone."""
    record = idle.submit(idle.upload(take))
    idle.jobs.delete(record.id)
    assert not [key for key in idle.redis.scan_iter() if record.id.encode() in key]
    assert not idle.redis.smembers(keys.LIVE_KEY)
    assert idle.jobs.depths() == {"analyse": 0, "cut": 0}


def horse(pool):
    """The process that does the running job: pool, worker, work-horse. Others stand ready beside it."""
    forks = [pid for depth, pid in descendants(pool.process.pid) if depth == 2]
    (found,) = [pid for pid in forks if Path(f"/proc/{pid}/comm").read_text().strip() == WORKING]
    return found


def nothing_started(place, seconds=3.0):
    """Whether RQ soon believes that nothing is running; it clears up after the record is written."""
    deadline = time.monotonic() + seconds
    while any(place.redis.zcard(f"rq:wip:{name}") for name in QUEUES):
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


def test_a_killed_work_horse_is_tried_again(place, long_take):
    """SIGKILL in the middle, as an out-of-memory killer does: the second attempt is done, and RQ has nothing left."""
    record = place.begun(place.submit(place.upload(long_take), **SLOWLY).id)
    os.kill(horse(place.pool), signal.SIGKILL)
    done = place.ended(record.id)
    assert (done.status, done.attempt) == ("done", 2)
    assert nothing_started(place)


def test_a_job_that_is_always_killed_fails_with_a_code(place, long_take):
    """Killed at every attempt, it ends, and says why."""
    record = place.submit(place.upload(long_take), **SLOWLY)
    for attempt in range(1, place.settings.attempts + 1):
        place.until(record.id, lambda r, attempt=attempt: r.attempt == attempt and r.stage)
        os.kill(horse(place.pool), signal.SIGKILL)
    failed = place.ended(record.id)
    assert (failed.status, failed.problem["code"]) == ("failed", "worker-killed")
    assert nothing_started(place)


def test_a_running_job_can_be_cancelled(place, long_take):
    """It stops within a second, and the worker takes the next one."""
    record = place.begun(place.submit(place.upload(long_take), **SLOWLY).id)
    assert place.jobs.cancel(record.id).status == "cancelled"
    assert nothing_started(place, seconds=2.0)
    assert place.records.segmentations.one(record.id).status == "cancelled"
    assert place.records.segmentations.result(record.id) == (None, None, None)


def test_a_clock_that_jumps_loses_no_attempt(idle, take):
    """A lease is Redis's to end: what our clocks say of a record, a year ago or ahead, makes nobody lost."""
    record = idle.submit(idle.upload(take))
    running = idle.records.attempts.begin(record.id, record.token)
    for jumped in (running.updated - 3e7, running.updated + 3e7):
        key = keys.segmentation_key(record.id)
        idle.redis.set(key, running.with_(updated=jumped, created=jumped).model_dump_json())
        assert [idle.jobs.reconcile() for _ in range(3)] == [0, 0, 0]
    assert 0 < idle.redis.ttl(keys.lease_key(record.token)) <= LEASE_SECONDS
    idle.redis.delete(keys.lease_key(record.token))
    assert [idle.jobs.reconcile() for _ in range(2)] == [0, 1]
