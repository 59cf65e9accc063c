"""Who works, as RQ keeps it in Redis: whether anybody of this machine is alive, and what the dead have left there."""

import socket
import time
from datetime import UTC, datetime, timedelta

from redis import Redis
from rq import Queue as RqQueue
from rq import Worker
from rq.serializers import JSONSerializer

from worker.queues import QUEUES

IDLE_SECONDS = 30  # between signs of life, and waits for a job, while a worker has none
FAR_SECONDS = 10**9


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
