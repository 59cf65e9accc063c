"""The queues, which are RQ's: jobs are put in, counted, found and taken out again. Nobody else asks RQ for that.

analyse  from the vertices to the result, in seconds to minutes
cut      what takes milliseconds: another cut of a stored analysis, files made of a result
"""

import logging
import signal
from typing import Any

from redis import Redis
from rq import Queue as RqQueue
from rq.command import send_stop_job_command
from rq.exceptions import DeserializationError, InvalidJobOperation, NoSuchJobError
from rq.job import Job
from rq.serializers import JSONSerializer
from rq.timeouts import JobTimeoutException, UnixSignalDeathPenalty

from caesura.core.errors import CaesuraError
from caesura.worker.records.record_types import Queue, SegmentationRecord

log = logging.getLogger(__name__)

QUEUES: tuple[Queue, ...] = ("analyse", "cut")
TASKS = {
    name: f"caesura.worker.tasks.run_{name}"
    for name in (*QUEUES, "alternatives", "export", "loops", "sweep", "collect", "propose", "search")
}
RESULT_SECONDS = 60  # how long RQ remembers what our record knows anyway
FAILURE_SECONDS = 24 * 3600
REMINDER_SECONDS = 5.0
"""Until a time limit that was swallowed is raised again: time enough to write down that it was reached."""


class TimeLimit(BaseException):
    """The job's time is up.

    No `Exception`: code that turns faults into problems of the file catches those, and the answer would be stored.
    """


class JobTimer(UnixSignalDeathPenalty):
    """RQ's timer, which raises `TimeLimit` where the time of a job is up. The system counts it, whatever clocks say.

    It raises it again and again: a library whose handlers catch everything cannot keep it to itself.
    """

    def __init__(self, timeout: float, exception: type[BaseException] = TimeLimit, **others: Any) -> None:
        raised = TimeLimit if exception is JobTimeoutException else exception
        super().__init__(timeout, raised, **others)  # type: ignore[no-untyped-call]

    def setup_death_penalty(self) -> None:
        """Start the timer."""
        super().setup_death_penalty()  # type: ignore[no-untyped-call]
        signal.setitimer(signal.ITIMER_REAL, self._timeout, REMINDER_SECONDS)


class TaskJob(Job):
    """An RQ job that runs a function of `TASKS` or nothing.

    RQ imports whatever function a job names, and calls back whatever the job says. Redis is where the names come from,
    so without this table whoever can write to Redis runs code on the workers.
    """

    success_callback = failure_callback = stopped_callback = None

    def restore(self, raw_data: Any) -> None:
        """Read a stored job; raises `NoSuchJobError`, which has RQ pass on, where it is none of ours."""
        super().restore(raw_data)
        self.webhooks = []
        try:
            known = self.func_name in TASKS.values() and self.instance is None
        except DeserializationError:
            known = False
        if not known:
            log.error("a job in Redis is not a task of this project and does not run: %r", self.id)
            raise NoSuchJobError(f"{self.id} is no task")


def rq_queue(name: str, client: Redis) -> RqQueue:
    """RQ's queue of this name, with our jobs in it."""
    return RqQueue(name, connection=client, job_class=TaskJob, serializer=JSONSerializer)


class QueueFull(CaesuraError):
    """As many jobs wait as may."""

    kind = "worker"


class Queues:
    """Both queues of one Redis. With `max_queued`, no more jobs than that may wait in them."""

    def __init__(self, client: Redis, max_queued: int = 0) -> None:
        self._redis = client
        self._most = max_queued
        self._queues = {name: rq_queue(name, client) for name in QUEUES}

    def put(self, queue: Queue, task: str, args: list[str], job_id: str, seconds: int, pipe: Any) -> None:
        """Put a job of at most `seconds` last in a queue, when `pipe` is executed."""
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

    def drop(self, token: str) -> None:
        """Take an attempt's RQ job out of its queue, or stop the worker that runs it."""
        try:
            job = TaskJob.fetch(token, connection=self._redis, serializer=JSONSerializer)
            if job.worker_name:
                send_stop_job_command(self._redis, token, serializer=JSONSerializer)
            else:
                job.delete()
        except (NoSuchJobError, InvalidJobOperation):
            return

    def position(self, record: SegmentationRecord) -> int | None:
        """How many jobs come before it in its queue; None where it does not wait there."""
        if record.status != "queued":
            return None
        found = self._redis.lpos(self.key(record.queue), record.token)
        return found if isinstance(found, int) else None

    def is_waiting(self, queue: Queue, job_id: str) -> bool:
        """Whether a job has a place in a queue."""
        return self._redis.lpos(self.key(queue), job_id) is not None

    def key(self, name: Queue) -> str:
        """The list that a queue is in Redis."""
        return str(self._queues[name].key)

    def depths(self) -> dict[str, int]:
        """How many jobs wait in each queue."""
        return {name: self._redis.llen(queue.key) for name, queue in self._queues.items()}

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
