"""Segmentations as jobs: RQ carries them, the record says how they are.

One attempt is one RQ job, and its id is the attempt's token. Whoever changes an attempt changes the token in the
same MULTI that queues or ends it, so an attempt that comes late finds that it is no longer the one.

    submit ── queued ── begin ── running ── finish ── done
                │                   ├── fail ── failed          the file, or a bug
                │                   ├── lost ── queued again, at once or after a pause, or failed after `attempts`
                │                   └── hand back ── queued again, not counted
                └── cancel ─────────┴── cancelled
"""

import logging
import time
from typing import Any

from redis import Redis, WatchError
from redis.client import Pipeline
from rq import Queue as RqQueue
from rq.command import send_stop_job_command
from rq.exceptions import InvalidJobOperation, NoSuchJobError
from rq.job import Job
from rq.serializers import JSONSerializer
from rq.timeouts import JobTimeoutException as TimeLimit

from core.errors import CaesuraError
from worker import ids, keys, tallies
from worker.connection import connect
from worker.records import Records
from worker.schema import ExportRecord, Queue, SegmentationRecord
from worker.settings import WorkerSettings

__all__ = ["Jobs", "QueueFull", "TimeLimit", "worker_problem"]

log = logging.getLogger(__name__)

QUEUES: tuple[Queue, ...] = ("analyse", "cut")
TASKS = {name: f"worker.tasks.run_{name}" for name in (*QUEUES, "alternatives", "export", "sweep")}
EXPORT_SECONDS = 120
SWEEP_SECONDS = 3600
RESULT_SECONDS = 60  # how long RQ remembers what our record knows anyway
FAILURE_SECONDS = 24 * 3600
FIRST_PAUSE_SECONDS, PAUSE_GROWTH, LONGEST_PAUSE_SECONDS = 2.0, 4, 60.0


def worker_problem(code: str, detail: str, **where: Any) -> dict[str, Any]:
    """A problem that is not the file's: posting the same again starts anew."""
    return {"kind": "worker", "code": code, "detail": detail, **where}


DELETED = {"kind": "request", "code": "not-found", "detail": "The segmentation was deleted meanwhile."}


def pause_seconds(attempt: int) -> float:
    """How long to wait after attempt 1, 2, …: 2 s, 8 s, 32 s, at most a minute."""
    return float(min(FIRST_PAUSE_SECONDS * PAUSE_GROWTH ** (attempt - 1), LONGEST_PAUSE_SECONDS))


class QueueFull(CaesuraError):
    """As many jobs wait as may."""

    kind = "worker"


class Jobs:
    """What can be asked of the queues. Safe to share between threads; the calls block for a few milliseconds."""

    def __init__(self, client: Redis, attempts: int = 3, job_seconds: int = 3600, max_queued: int = 0) -> None:
        self.records = Records(client)
        self.redis = client
        self._attempts = attempts
        self._seconds = job_seconds
        self._most = max_queued
        self._queues = {name: RqQueue(name, connection=client, serializer=JSONSerializer) for name in QUEUES}
        self._missed: set[str] = set()

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
            self.check_room()
            return self._attempt(kept, attempt=1)

        return self.records.segmentations.change(record.id, change, self._enqueue, new=record) or self._kept(record)

    def cancel(self, identifier: str) -> SegmentationRecord | None:
        """queued, running -> cancelled, and stop the worker; None where it was not live."""
        token = ""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            nonlocal token
            token = record.token  # of the attempt that is cancelled: it may be a newer one than was seen before
            return record.with_(status="cancelled", token="", stage="", fraction=0.0) if record.live else None

        after = self.records.segmentations.change(identifier, change)
        if after is not None:
            self._drop(token)
        return after

    def delete(self, identifier: str) -> None:
        """Cancel where it is live, then forget it and its result."""
        while True:
            self.cancel(identifier)
            record = self.records.segmentations.one(identifier)
            if record is None or self.records.segmentations.delete(record):
                return

    def position(self, record: SegmentationRecord) -> int | None:
        """How many jobs come before it in its queue; None where it does not wait there."""
        if record.status != "queued":
            return None
        found = self.redis.lpos(self.queue_key(record.queue), record.token)
        return found if isinstance(found, int) else None

    def queue_key(self, name: Queue) -> str:
        """The list that a queue is in Redis."""
        return str(self._queues[name].key)

    def depths(self) -> dict[str, int]:
        """How many jobs wait in each queue."""
        return {name: self.redis.llen(queue.key) for name, queue in self._queues.items()}

    def check_room(self) -> None:
        """Raises `QueueFull` where as many jobs wait as may."""
        waiting = sum(self.depths().values()) if self._most else 0
        if waiting >= self._most > 0:
            raise QueueFull(
                "queue-full",
                f"{waiting} jobs wait already, as many as this service lets wait. Nothing was queued; try again soon.",
                limit=self._most,
                actual=waiting,
                setting="CAESURA_MAX_QUEUED",
            )

    def submit_export(self, identifier: str, form: str) -> ExportRecord:
        """Have a file made of a result that is done, unless it is there or being made; see `Records.export`."""
        key = keys.export_key(identifier, form)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(key, keys.segmentation_key(identifier))
                kept = self.records.exports.one(identifier, form)
                if kept is not None and (kept.problem or {}).get("kind") != "worker":
                    return kept
                if not pipe.exists(keys.segmentation_key(identifier)):
                    return ExportRecord(problem=DELETED)
                self.check_room()
                pipe.multi()
                pipe.set(key, ExportRecord().model_dump_json(), ex=2 * EXPORT_SECONDS)  # then its job was lost
                pipe.sadd(keys.exports_key(identifier), form)
                self._call("cut", "export", [identifier, form], ids.token(), EXPORT_SECONDS, pipe)
                try:
                    pipe.execute()
                except WatchError:  # somebody else asked for it in this moment, or deleted it
                    continue
                return ExportRecord()

    # What workers say.

    def submit_alternatives(self, identifier: str) -> None:
        """Have the other numbers of motions worked out that a result has scored, when the takes before it are done."""
        with self.redis.pipeline() as pipe:
            self._call("analyse", "alternatives", [identifier], ids.token(), self._seconds, pipe)
            pipe.execute()

    def again(
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
                return record.with_(status="failed", problem=problem)
            fresh = self._attempt(record, attempt=record.attempt + 1)
            return fresh.with_(due=time.time() + pause_seconds(record.attempt)) if pause else fresh

        def also(pipe: Pipeline, after: SegmentationRecord) -> None:
            self._enqueue(pipe, after)
            tallies.count_lost(pipe, problem["code"])

        after = self.records.segmentations.change(identifier, change, also)
        if after is not None:
            log.warning("%s: attempt lost (%s), now %s", identifier, problem["code"], after.status)
        return after

    def hand_back(self, identifier: str, token: str, queue: Queue | None = None) -> SegmentationRecord | None:
        """Queue an attempt again that ends for no fault, such as a worker's shutdown; `queue` may be another."""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            wanted = record.token == token and record.live
            return self._attempt(record, attempt=record.attempt, queue=queue) if wanted else None

        return self.records.segmentations.change(identifier, change, self._enqueue)

    # How nothing is stuck.

    def reconcile(self, everything_started_is_lost: bool = False) -> int:
        """Find live segmentations that nobody works on and try them again; answers how many.

        Running without a lease, or queued without a place in a queue, at two calls in a row: one alone may be
        a clock that jumped, or a job on its way from the queue to its worker. Call every few seconds; any number
        of processes may. At the start of an embedded server no worker can be alive: then one call settles all.
        Those whose pause is over get their place in the queue.
        """
        live = self.records.segmentations.live()
        for paused in (record for record in live if record.due):
            self._resume(paused, at_once=everything_started_is_lost)
        live = [record for record in live if not record.due]
        missing = {record.token: record for record in live if not self._attended(record)}
        if everything_started_is_lost:
            missing = {r.token: r for r in live if r.status == "running" or not self._attended(r)}
        lost = set(missing) if everything_started_is_lost else set(missing) & self._missed
        self._missed = set(missing) - lost
        problem = worker_problem("worker-lost", "The worker was lost while it worked on this. Please try again.")
        return sum(self.again(missing[token].id, token, problem) is not None for token in lost)

    def sweep_sometimes(self) -> None:
        """Queue a look for what is kept too long, where nobody has within the last hour. Call it at any time."""
        if self.redis.set(keys.SWEPT_KEY, b"1", nx=True, ex=SWEEP_SECONDS):
            with self.redis.pipeline() as pipe:
                self._call("cut", "sweep", [], ids.token(), SWEEP_SECONDS, pipe)
                pipe.execute()

    def _resume(self, paused: SegmentationRecord, at_once: bool) -> None:
        """Queue it where its pause is over. One longer than any pause is a clock that jumped: that is over too."""
        left = paused.due - time.time()
        if at_once or left <= 0 or left > LONGEST_PAUSE_SECONDS:

            def change(record: SegmentationRecord) -> SegmentationRecord | None:
                same = record.token == paused.token and record.status == "queued" and record.due
                return record.with_(due=0.0) if same else None

            self.records.segmentations.change(paused.id, change, self._enqueue)

    def _attended(self, record: SegmentationRecord) -> bool:
        if record.status == "running":
            return bool(self.redis.exists(keys.lease_key(record.token)))
        return self.redis.lpos(self._queues[record.queue].key, record.token) is not None

    # One attempt, one RQ job.

    def _attempt(self, record: SegmentationRecord, attempt: int, queue: Queue | None = None) -> SegmentationRecord:
        """A fresh attempt at the same."""
        if queue is None:
            digest = ids.heavy_digest(record.chosen().heavy(), record.algorithm)
            queue = "analyse" if self.records.analyses.one(record.animation, digest) is None else "cut"
        fresh = {"stage": "", "fraction": 0.0, "problem": None, "attempt": attempt, "queue": queue, "due": 0.0}
        return record.with_(status="queued", token=ids.token(), **fresh)

    def _enqueue(self, pipe: Pipeline, record: SegmentationRecord) -> None:
        if record.status == "queued" and not record.due:
            self._call(record.queue, record.queue, [record.id, record.token], record.token, self._seconds, pipe)
            pipe.zadd(keys.USED_KEY, {record.animation: time.time()}, xx=True)

    def _call(self, queue: Queue, task: str, args: list[str], job_id: str, seconds: int, pipe: Any) -> None:
        self._queues[queue].enqueue_call(
            TASKS[task],
            args=args,
            job_id=job_id,
            timeout=seconds,
            result_ttl=RESULT_SECONDS,
            failure_ttl=FAILURE_SECONDS,
            description=" ".join([task, *args[:1]]),
            pipeline=pipe,
        )

    def _drop(self, token: str) -> None:
        """Take an attempt's RQ job out of its queue, or stop the worker that runs it."""
        try:
            job = Job.fetch(token, connection=self.redis, serializer=JSONSerializer)
            if job.worker_name:
                send_stop_job_command(self.redis, token, serializer=JSONSerializer)
            else:
                job.delete()
        except (NoSuchJobError, InvalidJobOperation):
            return

    def _kept(self, record: SegmentationRecord) -> SegmentationRecord:
        return self.records.segmentations.one(record.id) or self.submit(record)
