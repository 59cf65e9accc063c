"""However the work ends, the record says so, and only what another attempt may mend is tried again."""

import contextlib
import time

import pytest
from obstore.exceptions import GenericError
from redis.exceptions import ConnectionError as RedisAway
from redis.exceptions import OutOfMemoryError
from rq.timeouts import JobTimeoutException

from caesura.core.errors import InvalidModel, error_from_problem
from caesura.worker.queue import queues
from caesura.worker.queue.attempt import run_attempt
from caesura.worker.queue.queues import JobTimer, TimeLimit


@pytest.fixture
def queued(idle, take):
    """A segmentation that waits."""
    return idle.submit(idle.upload(take))


def ending_with(idle, queued, error):
    """The record after an attempt whose work raises `error`."""

    def work(attempt):
        attempt.progress("strain", 0.5)
        raise error

    run_attempt(idle.jobs, queued.id, queued.token, work)
    return idle.records.segmentations.one(queued.id)


def test_a_refusal_is_the_answer(idle, queued):
    """What a person can mend ends the job without fuss, and comes back as the same error."""
    error = InvalidModel("no-motion", "Nothing moves.", frame=0)
    failed = ending_with(idle, queued, error)
    assert failed.status == "failed"
    assert failed.settled
    assert str(error_from_problem(failed.problem)) == str(error)


@pytest.mark.parametrize(("error", "code"), [(MemoryError(), "out-of-memory"), (TimeLimit(), "out-of-time")])
def test_too_much_is_not_tried_again(idle, queued, error, code):
    """The next attempt would take as much; but posted again under higher limits, it starts anew."""
    failed = ending_with(idle, queued, error)
    assert (failed.status, failed.attempt, failed.problem["code"]) == ("failed", 1, code)
    assert failed.problem["setting"] in failed.problem["detail"]
    assert not failed.settled


def test_no_handler_takes_the_time_limit_for_a_fault_of_the_file(idle, queued):
    """The timer strikes inside a reader that turns any exception into a problem: it is not stored for ever."""

    def work(_):
        try:
            while True:
                time.sleep(0.01)
        except Exception as fault:
            raise InvalidModel("malformed-shape", "The file is broken.") from fault

    with JobTimer(1, JobTimeoutException):
        run_attempt(idle.jobs, queued.id, queued.token, work)
    failed = idle.records.segmentations.one(queued.id)
    assert (failed.status, failed.problem["code"], failed.settled) == ("failed", "out-of-time", False)


def test_a_library_that_swallows_the_time_limit_gets_it_again(idle, queued, monkeypatch):
    """A bare `except` in somebody else's reader catches it once, and the job would go on without a limit."""
    monkeypatch.setattr(queues, "REMINDER_SECONDS", 0.3)

    def work(_):
        with contextlib.suppress(BaseException):
            time.sleep(30)
        time.sleep(30)

    began = time.monotonic()
    with JobTimer(1, JobTimeoutException):
        run_attempt(idle.jobs, queued.id, queued.token, work)
    assert idle.records.segmentations.one(queued.id).problem["code"] == "out-of-time"
    assert time.monotonic() - began < 10


def test_the_time_limit_while_another_end_is_written_is_told(idle, queued, monkeypatch):
    """The timer strikes after the work has failed, and before the record says so."""
    fail = idle.records.attempts.fail

    def work(_):
        raise InvalidModel("no-motion", "Nothing moves.")

    def strike(*given):
        monkeypatch.setattr(idle.records.attempts, "fail", fail)
        raise TimeLimit

    monkeypatch.setattr(idle.records.attempts, "fail", strike)
    run_attempt(idle.jobs, queued.id, queued.token, work)
    failed = idle.records.segmentations.one(queued.id)
    assert (failed.status, failed.problem["code"]) == ("failed", "out-of-time")


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), RedisAway(), GenericError("unreachable")])
def test_what_is_out_of_reach_is_tried_again(idle, queued, error):
    """The store or the queue: another attempt may find it."""
    with pytest.raises(type(error)):
        ending_with(idle, queued, error)
    again = idle.records.segmentations.one(queued.id)
    assert (again.status, again.attempt) == ("queued", 2)


def test_a_bug_is_told_without_its_details(idle, queued):
    """One sentence for the client; the exception goes on to the log."""
    with pytest.raises(ZeroDivisionError):
        ending_with(idle, queued, ZeroDivisionError("secret path"))
    failed = idle.records.segmentations.one(queued.id)
    assert (failed.status, failed.problem["code"]) == ("failed", "internal-error")
    assert "secret" not in failed.model_dump_json()


def test_a_cancelled_attempt_stops_at_one_of_its_next_words(idle, queued):
    """Progress that nobody wants raises, and the job ends in peace."""
    stopped = []

    def work(attempt):
        attempt.progress("strain", 0.1)
        idle.jobs.cancel(queued.id)
        try:
            for step in range(100):
                attempt.progress("energy", step / 100)
                time.sleep(0.02)
        finally:
            stopped.append(True)
        raise AssertionError("not reached")

    run_attempt(idle.jobs, queued.id, queued.token, work)
    assert stopped
    assert idle.records.segmentations.one(queued.id).status == "cancelled"


def test_progress_never_goes_back_within_a_stage(idle, queued):
    """A second pass over the frames stays where the first one ended; another stage begins anew."""

    def work(attempt):
        attempt.progress("figure", 0.9)
        idle.until(queued.id, lambda record: record.fraction == 0.9)
        attempt.progress("figure", 0.1)
        attempt.progress("cut", 0.1)
        idle.until(queued.id, lambda record: record.stage == "cut")
        assert idle.records.segmentations.one(queued.id).fraction == 0.1
        attempt.progress("cut", 0.0)
        attempt.progress("cut", 0.2)
        idle.until(queued.id, lambda record: record.fraction == 0.2)

    run_attempt(idle.jobs, queued.id, queued.token, work)
    assert idle.records.segmentations.one(queued.id).status == "running"


def test_the_newest_word_is_told_and_work_does_not_wait_for_it(idle, queued):
    """A thousand words in no time are few writes; the last of them is read although no other follows."""

    def work(attempt):
        before = idle.redis.info("commandstats")["cmdstat_exec"]["calls"]
        for step in range(1000):
            attempt.progress("strain", step / 1000)
        attempt.progress("energy", 0.5)
        idle.until(queued.id, lambda record: (record.stage, record.fraction) == ("energy", 0.5))
        assert idle.redis.info("commandstats")["cmdstat_exec"]["calls"] - before < 10

    run_attempt(idle.jobs, queued.id, queued.token, work)


def test_a_word_that_cannot_be_told_ends_the_attempt_as_a_fault_of_the_machine(idle, queued):
    """Redis does not take it: the work hears of it at its next word, and is tried again."""

    def work(attempt):
        idle.redis.config_set("maxmemory", 1)
        try:
            for step in range(100):
                attempt.progress("strain", step / 100)
                time.sleep(0.02)
        finally:
            idle.redis.config_set("maxmemory", 0)

    with pytest.raises(OutOfMemoryError):
        run_attempt(idle.jobs, queued.id, queued.token, work)
    assert idle.records.segmentations.one(queued.id).attempt == 2
