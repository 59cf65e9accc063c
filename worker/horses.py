"""RQ's worker, as we want it: it dies with its parent, says that its job lives, and tells how a job was lost."""

import os
import signal
import socket
import time
from datetime import UTC, datetime, timedelta
from typing import Any

from redis import Redis
from rq import Queue as RqQueue
from rq import Worker
from rq.job import Job
from rq.serializers import JSONSerializer

from worker.attempt import OUT_OF_MEMORY, OUT_OF_TIME
from worker.jobs import QUEUES, Jobs, worker_problem
from worker.lifeline import die_with

MONITOR_SECONDS = 5  # between signs of life while a job runs
IDLE_SECONDS = 30  # between signs of life, and waits for a job, while none does
MAINTENANCE_SECONDS = 60
RECONNECT_SECONDS = 5.0
FAR_SECONDS = 10**9

KILLED = worker_problem(
    "worker-killed", "The process that worked on this was killed, most likely because the machine ran out of memory."
)


class CaesuraWorker(Worker):
    """Takes jobs from its queues, each in a fork of its own (the work-horse)."""

    max_connection_wait_time = RECONNECT_SECONDS
    log_result_lifespan = False

    def __init__(self, queues: list[str], client: Redis, jobs: Jobs) -> None:
        super().__init__(
            [RqQueue(name, connection=client, serializer=JSONSerializer) for name in queues],
            connection=client,
            serializer=JSONSerializer,
            job_monitoring_interval=MONITOR_SECONDS,
            maintenance_interval=MAINTENANCE_SECONDS,
            worker_ttl=IDLE_SECONDS,
            work_horse_killed_handler=self._lost,
        )
        self._jobs = jobs
        self._handing_back = False

    def main_work_horse(self, job: Job, queue: RqQueue) -> None:
        """In the fork: hang its life on the worker's, then do the job."""
        die_with(os.getppid())
        super().main_work_horse(job, queue)

    def unsubscribe(self) -> None:
        """At the end: RQ would wait a second for its listening thread, which ends with the process anyway."""

    def maintain_heartbeats(self, job: Job) -> None:
        """In the worker, every few seconds while the horse runs."""
        super().maintain_heartbeats(job)
        self._jobs.records.renew(job.id)

    def request_force_stop(self, signum: int, frame: Any) -> None:  # noqa: ARG002  a signal handler's arguments
        """The second signal: stop the job too, and let it be handed back; see `_lost`."""
        self._handing_back = True
        if self.horse_pid:
            self.kill_horse()

    def _lost(self, job: Job, pid: int | None, status: int | None, usage: Any) -> None:  # noqa: ARG002  RQ's hook
        """In the worker: the horse ended without a word."""
        if len(job.args) != 2 or job.args[1] != job.id:
            return  # not an attempt
        identifier, token = job.args
        if self._handing_back:
            self._jobs.hand_back(identifier, token)
            return
        ended_by = os.WTERMSIG(status) if status is not None and os.WIFSIGNALED(status) else None
        if status is None or ended_by == signal.SIGXCPU:
            self._jobs.records.fail(identifier, token, OUT_OF_TIME)
        elif ended_by in {signal.SIGABRT, signal.SIGSEGV}:
            self._jobs.again(identifier, token, OUT_OF_MEMORY)
        else:
            self._jobs.again(identifier, token, KILLED)


def alive_here(client: Redis) -> bool:
    """Whether a worker of this machine gave a sign of life lately."""
    latest = datetime.now(UTC) - timedelta(seconds=2 * IDLE_SECONDS)
    workers = Worker.all(connection=client, serializer=JSONSerializer)
    here = [worker for worker in workers if worker.hostname == socket.gethostname()]
    return any(worker.last_heartbeat is not None and worker.last_heartbeat > latest for worker in here)


def forget_workers(client: Redis) -> None:
    """Sweep what dead workers left in RQ's registries. Only where no worker can be alive: before the first starts."""
    for name in QUEUES:
        queue = RqQueue(name, connection=client, serializer=JSONSerializer)
        queue.started_job_registry.cleanup(timestamp=time.time() + FAR_SECONDS)
        client.delete(queue.intermediate_queue_key)
    for worker in Worker.all(connection=client, serializer=JSONSerializer):
        worker.register_death()
        client.delete(worker.key)
