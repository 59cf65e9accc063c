"""The state machine: one attempt at a time writes, and nothing is lost, stuck or done twice."""

import os
import signal
import time
from pathlib import Path

from caesura.worker.process.work_horse import WORKING
from caesura.worker.queue.job_problems import LOST
from caesura.worker.queue.queues import QUEUES
from caesura.worker.records import redis_keys
from tests.installation import SLOWLY, descendants

RESULT = {"energy": b"", "labels": b""}


def test_the_same_submission_is_one_job(idle, take):
    """Submitted again while it waits, the record is answered as it is, and the queue stays as long as it was."""
    animation = idle.upload(take)
    first = idle.submit(animation)
    assert idle.submit(animation) == first
    assert idle.jobs.queues.depths() == {"analyse": 1, "cut": 0}


def test_a_queued_job_can_be_cancelled_and_comes_back(idle, take):
    """Cancelled, it leaves the queue; posted again, it is a new attempt."""
    animation = idle.upload(take)
    first = idle.submit(animation)
    assert idle.jobs.cancel(first.id).status == "cancelled"
    assert idle.jobs.queues.depths() == {"analyse": 0, "cut": 0}
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
    newer = idle.jobs.retry(old.id, old.token, LOST)
    assert (newer.status, newer.attempt) == ("queued", 2)
    assert idle.records.attempts.change(old.id, old.token, stage="late") is None
    assert not idle.records.attempts.finish(old.id, old.token, "late", RESULT)
    assert not idle.records.attempts.fail(old.id, old.token, LOST)
    assert idle.jobs.retry(old.id, old.token, LOST) is None
    assert idle.records.segmentations.one(old.id) == newer
    assert idle.records.segmentations.result(old.id) == (None, None, None)


def test_attempts_are_bounded_and_then_posting_again_starts_anew(idle, take):
    """Lost for the third time it fails with the reason; that was not the file's fault, so it may be posted again."""
    animation = idle.upload(take)
    record = idle.submit(animation)
    for _ in range(idle.settings.attempts):
        record = idle.jobs.retry(record.id, record.token, LOST)
    assert (record.status, record.problem) == ("failed", LOST)
    fresh = idle.submit(animation)
    assert (fresh.status, fresh.attempt, fresh.problem) == ("queued", 1, None)


def test_a_deleted_segmentation_leaves_nothing(idle, take):
    """No key of it stays, and its job is gone."""
    record = idle.submit(idle.upload(take))
    idle.jobs.delete(record.id)
    assert not [key for key in idle.redis.scan_iter() if record.id.encode() in key]
    assert not idle.redis.smembers(redis_keys.LIVE_SEGMENTATIONS_KEY)
    assert idle.jobs.queues.depths() == {"analyse": 0, "cut": 0}


def horse(pool):
    """The process that does the running job: pool, worker, work-horse. Others stand ready beside it."""
    deadline = time.monotonic() + 10
    while time.monotonic() < deadline:
        forks = [pid for depth, pid in descendants(pool.process.pid) if depth == 2]
        found = [pid for pid in forks if comm(pid) == WORKING]
        if len(found) == 1:  # one that was killed may still be on its way out
            return found[0]
        time.sleep(0.02)
    raise TimeoutError(f"{len(found)} jobs run")


def comm(pid):
    """The name of a process, empty once it is gone."""
    try:
        return Path(f"/proc/{pid}/comm").read_text().strip()
    except OSError:
        return ""


def started(place):
    """The jobs that RQ believes to be running; another test may have killed a worker that it still waits for."""
    return {job for name in QUEUES for job in place.redis.zrange(f"rq:wip:{name}", 0, -1)}


def nothing_started(place, before, seconds=10.0):
    """Whether RQ soon believes that nothing is running but what was `before`."""
    deadline = time.monotonic() + seconds
    while started(place) - before:
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


def test_a_killed_work_horse_is_tried_again(place, long_take):
    """SIGKILL in the middle, as an out-of-memory killer does: the second attempt is done, and RQ has nothing left."""
    before = started(place)
    record = place.begun(place.submit(place.upload(long_take), **SLOWLY).id)
    os.kill(horse(place.pool), signal.SIGKILL)
    done = place.ended(record.id)
    assert (done.status, done.attempt) == ("done", 2)
    assert nothing_started(place, before)


def test_a_job_that_is_always_killed_fails_with_a_code(place, long_take):
    """Killed at every attempt, it ends, and says why."""
    before = started(place)
    record = place.submit(place.upload(long_take), **SLOWLY)
    for attempt in range(1, place.settings.attempts + 1):
        place.until(record.id, lambda r, attempt=attempt: r.attempt == attempt and r.stage)
        os.kill(horse(place.pool), signal.SIGKILL)
    failed = place.ended(record.id)
    assert (failed.status, failed.problem["code"]) == ("failed", "worker-killed")
    assert nothing_started(place, before)


def test_a_running_job_can_be_cancelled(place, long_take):
    """It stops within a second, and the worker takes the next one."""
    before = started(place)
    record = place.begun(place.submit(place.upload(long_take), **SLOWLY).id)
    assert place.jobs.cancel(record.id).status == "cancelled"
    assert nothing_started(place, before, seconds=2.0)
    assert place.records.segmentations.one(record.id).status == "cancelled"
    assert place.records.segmentations.result(record.id) == (None, None, None)
