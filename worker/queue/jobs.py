"""Segmentations as jobs: RQ carries them, the record says how they are.

One attempt is one RQ job, and its id is the attempt's token. Whoever changes an attempt changes the token in the
same MULTI that queues or ends it, so an attempt that comes late finds that it is no longer the one.

    submit ── queued ── begin ── running ── finish ── done
                │                   ├── fail ── failed          the file, or a bug
                │                   ├── lost ── queued again, at once or after a pause, or failed after `attempts`
                │                   └── hand back ── queued again, not counted
                └── cancel ─────────┴── cancelled

`begin`, `finish` and `fail` are the worker's, who holds the token: `caesura.worker.records.attempts`.
What is lost is told by
the worker that lost it, or found by `caesura.worker.queue.orphaned_jobs`.
"""

import logging
import time
from typing import Any

from redis import Redis
from redis.client import Pipeline

from caesura.worker.queue.queues import Queues
from caesura.worker.records import Records, content_ids, counters, redis_keys
from caesura.worker.records.connection import connect
from caesura.worker.records.record_types import Queue, SegmentationRecord
from caesura.worker.settings import WorkerSettings

log = logging.getLogger(__name__)

FIRST_PAUSE_SECONDS, PAUSE_GROWTH, LONGEST_PAUSE_SECONDS = 2.0, 4, 60.0


class Jobs:
    """What can be asked of a segmentation. Safe to share between threads; the calls block for a few milliseconds."""

    def __init__(self, client: Redis, attempts: int = 3, job_seconds: int = 3600, max_queued: int = 0) -> None:
        self.redis = client
        self.records = Records(client)
        self.queues = Queues(client, max_queued)
        self.job_seconds = job_seconds
        self.records.segmentations.follow = self._follow
        self._attempts = attempts

    @classmethod
    def open(cls, settings: WorkerSettings) -> "Jobs":
        """The jobs of the Redis that the settings name."""
        client = connect(settings.redis_location)
        return cls(client, settings.attempts, settings.job_seconds, settings.max_queued)

    # What the service asks.

    def submit(self, record: SegmentationRecord) -> SegmentationRecord:
        """Queue a new segmentation, and answer the record as it is now kept.

        The same one queued, running, done or failed because of the file is answered as it is, without a second
        job; cancelled, or failed because of this installation, it starts anew. An animation that is analysed
        already, with the same heavy parameters, goes straight to `cut`. Raises `QueueFull` where it would be one
        too many, `AnimationDeleted` where the animation has gone meanwhile.
        """

        def change(kept: SegmentationRecord) -> SegmentationRecord | None:
            if kept is not record and (kept.live or kept.settled):
                return None
            self.queues.check_room()
            return self._attempt(kept, attempt=1)

        return self.records.segmentations.change(record.id, change, self._enqueue, new=record) or self._kept(record)

    def cancel(self, identifier: str) -> SegmentationRecord | None:
        """queued, running -> cancelled, and stop the worker; None where it was not live."""
        token = ""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            nonlocal token
            token = record.token  # of the attempt that is cancelled: it may be a newer one than was seen before
            return record.with_changes(status="cancelled", token="", stage="", fraction=0.0) if record.live else None

        after = self.records.segmentations.change(identifier, change)
        if after is not None:
            self.queues.drop(token)
        return after

    def delete(self, identifier: str) -> None:
        """Cancel where it is live, then forget it and its result."""
        while True:
            self.cancel(identifier)
            record = self.records.segmentations.one(identifier)
            if record is None or self.records.segmentations.delete(record):
                return

    # What workers say, and who watches them.

    def retry(
        self, identifier: str, token: str, problem: dict[str, Any], pause: bool = False
    ) -> SegmentationRecord | None:
        """The attempt was lost to the infrastructure: try once more, or fail with `problem` after the last attempt.

        With a pause, which grows from attempt to attempt, where what failed needs time to come back. None where the
        attempt is no longer the current one: then nothing is changed.
        """

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            if record.token != token or not record.live:
                return None
            if record.attempt >= self._attempts:
                return record.with_changes(status="failed", problem=problem)
            fresh = self._attempt(record, attempt=record.attempt + 1)
            return fresh.with_changes(due=time.time() + retry_delay_seconds(record.attempt)) if pause else fresh

        def also(pipe: Pipeline, after: SegmentationRecord) -> None:
            self._enqueue(pipe, after)
            counters.count_lost(pipe, problem["code"])

        after = self.records.segmentations.change(identifier, change, also)
        if after is not None:
            log.warning("%s: attempt lost (%s), now %s", identifier, problem["code"], after.status)
        return after

    def resume(self, identifier: str, token: str) -> SegmentationRecord | None:
        """The pause before an attempt is over: it gets its place in the queue."""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            same = record.token == token and record.status == "queued" and record.due
            return record.with_changes(due=0.0) if same else None

        return self.records.segmentations.change(identifier, change, self._enqueue)

    def hand_back(self, identifier: str, token: str, queue: Queue | None = None) -> SegmentationRecord | None:
        """Queue an attempt again that ends for no fault, such as a worker's shutdown; `queue` may be another."""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            wanted = record.token == token and record.live
            return self._attempt(record, attempt=record.attempt, queue=queue) if wanted else None

        return self.records.segmentations.change(identifier, change, self._enqueue)

    # One attempt, one RQ job.

    def _attempt(self, record: SegmentationRecord, attempt: int, queue: Queue | None = None) -> SegmentationRecord:
        """A fresh attempt at the same."""
        if queue is None:
            digest = content_ids.heavy_digest(record.chosen().heavy(), record.algorithm)
            queue = "analyse" if self.records.analyses.one(record.animation, digest) is None else "cut"
        fresh = {"stage": "", "fraction": 0.0, "problem": None, "attempt": attempt, "queue": queue, "due": 0.0}
        return record.with_changes(status="queued", token=content_ids.random_token(), **fresh)

    def _enqueue(self, pipe: Pipeline, record: SegmentationRecord) -> None:
        if record.status == "queued" and not record.due:
            args = [record.id, record.token]
            self.queues.put(record.queue, record.queue, args, record.token, self.job_seconds, pipe)
            pipe.zadd(redis_keys.LAST_USED_KEY, {record.animation: time.time()}, xx=True)

    def _follow(self, pipe: Pipeline, follower: str) -> None:
        """Have what waited for a segmentation go on: a collection, or a search in one with the token of its job."""
        collection, *search = follower.split(" ")
        if search:
            self.queues.put("cut", "search", [collection, search[0]], search[1], self.job_seconds, pipe)
        else:
            self.queues.put("analyse", "collect", [collection], content_ids.random_token(), self.job_seconds, pipe)

    def _kept(self, record: SegmentationRecord) -> SegmentationRecord:
        return self.records.segmentations.one(record.id) or self.submit(record)


def retry_delay_seconds(attempt: int) -> float:
    """How long to wait after attempt 1, 2, …: 2 s, 8 s, 32 s, at most a minute."""
    return float(min(FIRST_PAUSE_SECONDS * PAUSE_GROWTH ** (attempt - 1), LONGEST_PAUSE_SECONDS))
