"""RQ's worker with a parent watch, a heartbeat for each job, a work-horse, and a record of lost jobs."""

import gc
import json
import os
import random
import signal
import time
from collections.abc import Callable
from typing import Any

from redis import Redis
from redis.client import Pipeline
from rq import Queue as RqQueue
from rq import Worker
from rq.executions import Execution
from rq.job import Job
from rq.serializers import JSONSerializer

from caesura.worker.process.job_quota import resident_bytes
from caesura.worker.process.work_horse import WorkHorse
from caesura.worker.process.worker_registry import IDLE_SECONDS, record_heartbeat
from caesura.worker.queue.collection_jobs import fail_collection_job
from caesura.worker.queue.job_problems import KILLED, OUT_OF_MEMORY, OUT_OF_TIME
from caesura.worker.queue.jobs import Jobs
from caesura.worker.queue.queues import TASKS, JobTimer, TaskJob, rq_queue
from caesura.worker.records.connection import tolerate_full_disk
from caesura.worker.records.record_types import ExportRecord

MONITOR_SECONDS = 5  # between signs of life while a job runs
MAINTENANCE_SECONDS = 60
RECONNECT_SECONDS = 5.0
ANALYSE_NICE = 10
JOBS_PER_WORK_HORSE = 200
KEPT_BYTES = 256 * 2**20
"""A horse that has grown by more ends, so that its memory goes back."""
KEPT_TASKS = frozenset({TASKS["analyse"], TASKS["cut"], TASKS["search"]})
COLLECTION_TASKS = ("collect", "propose", "search")


class CaesuraWorker(Worker):
    """Takes jobs from its queues, and has them done by a fork that stands ready (the work-horse)."""

    death_penalty_class = JobTimer
    max_connection_wait_time = RECONNECT_SECONDS
    log_result_lifespan = False

    def __init__(
        self, queues: list[str], client: Redis, jobs: Jobs, prepare: Callable[[], None] = lambda: None
    ) -> None:
        super().__init__(
            [rq_queue(name, client) for name in queues],
            connection=client,
            job_class=TaskJob,
            serializer=JSONSerializer,
            job_monitoring_interval=MONITOR_SECONDS,
            maintenance_interval=MAINTENANCE_SECONDS,
            worker_ttl=IDLE_SECONDS,
            work_horse_killed_handler=self._handle_lost_job,
        )
        self._jobs = jobs
        self._prepare = prepare
        self._handing_back = False
        self._horse: WorkHorse | None = None
        self._done = 0
        self._small = 0
        self._given = 0.0
        self._yields = False

    def execute_job(self, job: Job, queue: RqQueue) -> None:
        """In the worker: have a job done, and the next horse stand ready before the next job comes."""
        self._jobs.records.attempts.renew(job.id)
        super().execute_job(job, queue)
        if self._horse is not None and self._horse.status is not None:
            self._reap()
        self.prefork()

    def prefork(self) -> None:
        """Fork a horse, where none is ready."""
        if self._horse is None:
            self._horse = WorkHorse(self._prepare, self._perform)

    def fork_work_horse(self, job: Job, queue: RqQueue) -> None:
        """In the worker: give the job to the horse."""
        assert self.execution is not None  # noqa: S101  RQ has just made it
        order = json.dumps([job.id, self.execution.id, queue.name])
        self.prefork()
        while self._horse is not None and not self._horse.start_job(order):  # it was killed while it stood there
            self._reap()
            self.prefork()
        assert self._horse is not None  # noqa: S101  made above
        self._horse_pid = self._horse.pid
        self._given = time.monotonic()

    def wait_for_horse(self) -> tuple[int | None, int | None, Any]:
        """In the worker: until the job is over."""
        assert self._horse is not None  # noqa: S101  it got the job
        return *self._horse.wait(), None

    def _reap(self) -> None:
        if self._horse is not None:
            self._horse.close()
            self._horse = None

    def _perform(self, order: str) -> bool:
        """In the horse: do a job. The same horse does many of the usual ones, as long as it stays small.

        What yields once yields for good, so a horse that has analysed cuts at its low priority too: the worker on
        `cut` alone does not.
        """
        job_id, execution, name = json.loads(order)
        queue = rq_queue(name, self.connection)
        job = TaskJob.fetch(job_id, connection=self.connection, serializer=JSONSerializer)
        self.execution = Execution(execution, job_id, self.connection, self.name)
        self._is_horse = True
        if name == "analyse" and not self._yields:
            self._yields = True
            lower_priority()
        random.seed()
        self._done += 1
        self._small = self._small or resident_bytes()
        done = self.perform_job(job, queue) and job.func_name in KEPT_TASKS and self._done < JOBS_PER_WORK_HORSE
        gc.collect()
        return done and resident_bytes() - self._small < KEPT_BYTES

    def set_current_job_working_time(self, current_job_working_time: float, pipeline: Pipeline | None = None) -> None:
        """In the worker: how long the job has run, for RQ kills one that runs too long; by a clock that cannot jump."""
        seconds = time.monotonic() - self._given if current_job_working_time else 0.0
        super().set_current_job_working_time(seconds, pipeline)

    def unsubscribe(self) -> None:
        """At the end: RQ would wait a second for its listening thread, which ends with the process anyway."""

    def heartbeat(self, timeout: int | None = None, pipeline: Pipeline | None = None) -> None:
        """In the worker, and as a job begins: say that it lives."""
        super().heartbeat(timeout, pipeline)
        record_heartbeat(self, pipeline if pipeline is not None else self.connection)

    def maintain_heartbeats(self, job: Job) -> None:
        """In the worker, every few seconds while the horse runs; a full disk of Redis's is for the horse to meet."""
        with tolerate_full_disk():
            super().maintain_heartbeats(job)
            self._jobs.records.attempts.renew(job.id)

    def request_force_stop(self, signum: int, frame: Any) -> None:  # noqa: ARG002  a signal handler's arguments
        """The second signal: stop the job too, and let it be handed back; see `_lost`."""
        self._handing_back = True
        if self.horse_pid:
            self.kill_horse()

    def _handle_lost_job(self, job: Job, pid: int | None, status: int | None, usage: Any) -> None:  # noqa: ARG002  RQ's hook
        """In the worker: the horse ended without a word."""
        ended_by = os.WTERMSIG(status) if status is not None and os.WIFSIGNALED(status) else None
        if status is None or ended_by == signal.SIGXCPU:
            problem = OUT_OF_TIME
        else:
            problem = OUT_OF_MEMORY if ended_by in {signal.SIGABRT, signal.SIGSEGV} else KILLED
        if job.func_name == TASKS["export"] and not self._handing_back:
            identifier, form = job.args
            self._jobs.records.exports.write(identifier, form, ExportRecord(problem=problem, created=time.time()))
        for task in COLLECTION_TASKS:
            if job.func_name == TASKS[task] and not self._handing_back:
                fail_collection_job(self._jobs, task, job.args, problem)
        if job.func_name not in KEPT_TASKS:
            return  # not an attempt
        identifier, token = job.args
        if self._handing_back:
            self._jobs.hand_back(identifier, token)
        elif problem == OUT_OF_TIME:
            self._jobs.records.attempts.fail(identifier, token, problem)
        else:
            self._jobs.retry(identifier, token, problem)


def lower_priority() -> None:
    """Let this process, and the threads it will have, work in what time the others leave.

    On a machine with nothing else to do it is as fast as before. Where the web process or a short job wakes up, it
    goes first, at once: nice 10 is a tenth of their share, and a batch process interrupts nobody.
    """
    os.nice(ANALYSE_NICE)
    if hasattr(os, "SCHED_BATCH"):
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
