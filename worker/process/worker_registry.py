"""Who works, as Redis keeps it: which queues are served, whether anybody of this machine is alive, and who is dead.

A worker is warm when it registers: everything was compiled before it was forked (`caesura.worker.process.warm_up`).
Its sign of life
is a key that Redis ends, so no two clocks are compared.
"""

import socket
import time

from redis import Redis
from redis.client import Pipeline
from rq import Worker, worker_registration
from rq.serializers import JSONSerializer

from caesura.worker.queue.queues import QUEUES, rq_queue
from caesura.worker.records import redis_keys
from caesura.worker.records.connection import names
from caesura.worker.records.schema import Queue

IDLE_SECONDS = 30  # a worker without a job gives a sign of life twice in so long
REMOTE_SILENCE_SECONDS = 10**9


def sign(worker: Worker, pipe: "Redis | Pipeline") -> None:
    """Say that a worker lives, and serves its queues; also to a Redis that was emptied meanwhile."""
    worker_registration.register(worker, pipe)  # type: ignore[arg-type]  # sadd alone, which both have
    pipe.set(redis_keys.worker_key(worker.name), socket.gethostname(), ex=IDLE_SECONDS)


def unserved(client: Redis) -> list[Queue]:
    """The queues that no living worker takes jobs from."""
    return [name for name in QUEUES if not _hosts(client, worker_registration.WORKERS_BY_QUEUE_KEY % name)]


def has_live_worker_here(client: Redis) -> bool:
    """Whether a worker of this machine gave a sign of life lately."""
    return socket.gethostname() in _hosts(client, worker_registration.REDIS_WORKER_KEYS)


def _hosts(client: Redis, registry: str) -> list[str]:
    """Where the living workers of one of RQ's sets are."""
    workers = [key.removeprefix(Worker.redis_worker_namespace_prefix) for key in names(client.smembers(registry))]
    return names(host for host in client.mget(map(redis_keys.worker_key, workers)) if host) if workers else []


def remove_dead_workers(client: Redis) -> None:
    """Sweep what dead workers left in RQ's registries. Only where no worker can be alive: before the first starts."""
    for name in QUEUES:
        queue = rq_queue(name, client)
        queue.started_job_registry.cleanup(timestamp=time.time() + REMOTE_SILENCE_SECONDS)
        client.delete(queue.intermediate_queue_key)
    for worker in Worker.all(connection=client, serializer=JSONSerializer):
        worker.register_death()
        client.delete(worker.key, redis_keys.worker_key(worker.name))
