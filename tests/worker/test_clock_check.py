"""A clock that jumps: it fails no job, and nothing is deleted for its age before it has gone evenly for a day."""

import os
import subprocess
import sys
import time

import pytest

from caesura.worker.queue.auxiliary_jobs import SWEEP_SECONDS, submit_sweep_if_due
from caesura.worker.queue.orphaned_jobs import OrphanedJobWatch
from caesura.worker.records import redis_keys
from caesura.worker.retention.sweep import sweep_by_clock

DAY = 24 * 3600.0
KEPT_UPLOAD, KEPT_RESULT = 7 * DAY, 30 * DAY

WORKER = """
import os, time
from pathlib import Path
from caesura.worker.process import rq_worker as horses
from caesura.worker import tasks
from caesura.worker.queue.attempt import run_attempt
from caesura.worker.records.connection import connect
from caesura.worker.queue.jobs import Jobs
from caesura.worker.settings import WorkerSettings

def work(attempt):
    Path(os.environ["JUMPING_CLOCK"]).write_text("7200")
    time.sleep(3)
    empty = {"energy": b"", "labels": b""}
    attempt.records.attempts.finish(attempt.record.id, attempt.record.token, "{}", empty)

settings = WorkerSettings()
jobs = Jobs.open(settings)
tasks.run_analyse = lambda identifier, token: run_attempt(jobs, identifier, token, work)
horses.MONITOR_SECONDS = 1
horses.CaesuraWorker(["analyse"], connect(settings.redis_location), jobs).work(burst=True)
"""


def test_two_hours_ahead_fail_no_running_job(idle, take, checkout, tmp_path):
    """A job of an hour at most runs when the clock is put forward by two: it goes on, and is done."""
    record = idle.submit(idle.upload(take))
    offset = tmp_path / "offset"
    offset.write_text("0")
    path = f"{checkout / 'benchmarks' / 'chaos' / 'jumping_clock'}:{checkout}"
    environment = {**os.environ, **idle.settings.environment(), "PYTHONPATH": path, "JUMPING_CLOCK": str(offset)}
    subprocess.run([sys.executable, "-c", WORKER], env=environment, check=True, timeout=60)
    assert offset.read_text() == "7200"
    ended = idle.records.segmentations.one(record.id)
    assert (ended.status, ended.attempt, ended.problem) == ("done", 1, None)


@pytest.fixture
def look(idle):
    """Sweeps as the hourly job does, at a time given in days from now; which blobs are left."""

    def look(days):
        sweep_by_clock(idle.jobs, idle.blobs, KEPT_UPLOAD, KEPT_RESULT, time.time() + days * DAY)
        return sorted(key for key, _ in idle.blobs.all())

    return look


def test_forty_days_ahead_delete_nothing_and_are_said(idle, take, look, caplog):
    """Not at the first sweep, nor when the clock is put right again; nor is a blob that no record points to yet."""
    upload = idle.upload(take).parts[0].key
    look(0)
    fresh = idle.blobs.put(b"a running job's", "analyses")
    for days in (40, 40.1, 0.1, 0.2):
        assert look(days) == sorted([upload, fresh]), days
    assert "Nothing is deleted for its age until" in caplog.text
    assert "the clock jumped" in caplog.text


def test_the_first_sweep_of_all_knows_a_jump_by_the_last_use(take, idle, look):
    """No sweep was there to note the time; the upload was."""
    upload = idle.upload(take).parts[0].key
    assert look(40) == [upload]


def test_after_a_day_of_an_even_clock_the_sweep_deletes_again(take, idle, look):
    """A machine that was off for long: what is too old goes a day later."""
    upload = idle.upload(take).parts[0].key
    for hours in range(24):
        assert look(40 + hours / 24) == [upload]
    assert look(41.01) == []


def test_nights_and_weekends_without_a_sweep_are_no_jump(take, idle, look):
    """A laptop: what is a week old goes at the first sweep of the morning."""
    idle.upload(take)
    for days in (0, 0.5, 3, 5, 6.9):
        assert look(days)
    assert look(7.5) == []


def test_what_redis_was_told_while_its_clock_was_ahead_does_not_last(idle, take):
    """A lease or an hour's pause that would end in forty days is none."""
    submit_sweep_if_due(idle.jobs)
    idle.redis.expire(redis_keys.LAST_SWEEP_KEY, int(40 * DAY))
    submit_sweep_if_due(idle.jobs)
    assert idle.redis.ttl(redis_keys.LAST_SWEEP_KEY) <= SWEEP_SECONDS
    watch, record = OrphanedJobWatch(idle.jobs), idle.submit(idle.upload(take))
    idle.records.attempts.begin(record.id, record.token)
    idle.redis.expire(redis_keys.lease_key(record.token), int(40 * DAY))
    assert [watch.look(), watch.look()] == [0, 1]
