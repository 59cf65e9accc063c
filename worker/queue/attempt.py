"""One attempt at one segmentation: how far it tells it is, and how it learns that it is no longer wanted."""

import logging
import time
from collections.abc import Callable
from typing import Any

from caesura.core.errors import CaesuraError
from caesura.worker import logs
from caesura.worker.queue.job_problems import (
    DELETED,
    INFRASTRUCTURE,
    INTERNAL_ERROR,
    OUT_OF_MEMORY,
    OUT_OF_TIME,
    UNAVAILABLE,
)
from caesura.worker.queue.jobs import Jobs
from caesura.worker.queue.progress_reporter import ProgressReporter
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records import counters
from caesura.worker.records.schema import SegmentationRecord
from caesura.worker.store.blobs import BlobMissing

log = logging.getLogger(__name__)


class Superseded(Exception):
    """Another attempt, or none, is wanted now."""


class Attempt:
    """A running attempt. `record` is as it was when it began."""

    def __init__(self, jobs: Jobs, record: SegmentationRecord) -> None:
        self.records = jobs.records
        self.jobs = jobs
        self.record = record
        self.stage_seconds: dict[str, float] = {}
        self._stage_began = time.monotonic()
        self._stage = ""
        self._fraction = 0.0
        self._teller = ProgressReporter(self._write)

    def progress(self, stage: str, fraction: float) -> None:
        """Have it told where it is; raises `Superseded` where an earlier word found that nobody wants it any more.

        A stage that needs a second pass stays where it was until that is further: progress never goes back.
        """
        if stage != self._stage:
            self.end_stage()
            self._stage, self._fraction = stage, 0.0
        self._fraction = min(max(fraction, self._fraction), 1.0)
        if not self._teller.say(stage, self._fraction):
            raise Superseded

    def end(self) -> None:
        """Nothing more is told, and the last stage is over."""
        self._teller.stop()
        self.end_stage()

    def _write(self, stage: str, fraction: float) -> bool:
        record = self.record
        return self.records.attempts.change(record.id, record.token, stage=stage, fraction=fraction) is not None

    def end_stage(self) -> None:
        """Count how long the stage took that is over now."""
        now = time.monotonic()
        if self._stage:
            before = self.stage_seconds.get(self._stage, 0.0)
            self.stage_seconds[self._stage] = before + now - self._stage_began
        self._stage_began = now

    def fail(self, problem: dict[str, Any]) -> None:
        """End it with a problem."""
        self.records.attempts.fail(self.record.id, self.record.token, problem)

    def again(self, problem: dict[str, Any]) -> None:
        """Try it once more after a pause, or end it with the problem after the last attempt."""
        self.jobs.again(self.record.id, self.record.token, problem, pause=True)


def run_attempt(jobs: Jobs, identifier: str, token: str, work: Callable[[Attempt], None]) -> None:
    """Run one attempt to its end, whichever that is. What a person can mend ends the job normally.

    The store or the queue out of reach: tried again, a bounded number of times. Anything else is a bug of ours: the
    record says so in one sentence, and the exception goes on to RQ, which logs it.
    """
    record = jobs.records.attempts.begin(identifier, token)
    if record is None:
        log.info("%s: this attempt is no longer wanted", identifier)
        return
    attempt = Attempt(jobs, record)
    with logs.log_context(request=record.request, segmentation=identifier):
        try:
            _run_work(attempt, work)
        except TimeLimit:  # also where another end was being written: what is written already stays
            attempt.fail(OUT_OF_TIME)
        finally:
            attempt.end()
        counters.count_stages(jobs.redis, attempt.stage_seconds)
        log.info("attempt %d ended", record.attempt, extra={"told": _milliseconds(attempt.stage_seconds)})


def _run_work(attempt: Attempt, work: Callable[[Attempt], None]) -> None:
    try:
        work(attempt)
    except Superseded:
        log.info("stopped, for it is no longer wanted")
    except CaesuraError as refusal:
        attempt.fail(refusal.problem())
    except BlobMissing:
        attempt.fail(DELETED)
    except MemoryError:
        attempt.fail(OUT_OF_MEMORY)
    except TimeLimit:
        raise
    except INFRASTRUCTURE:
        attempt.again(UNAVAILABLE)
        raise
    except BaseException:  # a panic of the store's library is no Exception
        attempt.fail(INTERNAL_ERROR)
        raise


def _milliseconds(seconds: dict[str, float]) -> dict[str, int]:
    """How long each stage took, for the log."""
    return {f"{stage}_ms": round(took * 1000) for stage, took in seconds.items()}
