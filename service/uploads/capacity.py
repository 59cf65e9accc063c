"""Whether there is capacity for new work: Redis memory, disk space, and a store that answers.

Without room work is refused at the door, while what is there is still finished and read: a full Redis could not even
say that a job is done. What was looked at is believed for a second, so that asking costs nothing.
"""

import os
import shutil
import time

from anyio import move_on_after, to_thread
from fastapi import Request
from obstore.exceptions import BaseError as StoreError
from redis import Redis
from redis.exceptions import RedisError

from caesura.service.backend import Backend, BackendDependency
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.process.worker_registry import unserved_queues
from caesura.worker.records.connection import refuses_writes

FULL_SHARE = 0.8
"""Share of the memory that Redis may use above which no more work is taken."""

BELIEVED_SECONDS = 1.0
PATIENCE_SECONDS = 3.0


class Capacity:
    """The capacity as last measured, for up to a second."""

    def __init__(self) -> None:
        self._seen = float("-inf")
        self._shortage = ""

    async def shortage(self, backend: Backend) -> str:
        """What is full or does not answer, as a sentence; empty while there is capacity."""
        now = time.monotonic()
        if now - self._seen >= BELIEVED_SECONDS:
            self._shortage = await find_shortage(backend)
            self._seen = now
        return self._shortage


async def find_shortage(backend: Backend) -> str:
    """Measure the capacity now; an answer that takes too long counts as none."""
    with move_on_after(PATIENCE_SECONDS):
        return await to_thread.run_sync(_find_shortage, backend, abandon_on_cancel=True)
    return "The service waits for its Redis or its store."


def _find_shortage(backend: Backend) -> str:
    settings = backend.settings
    try:
        backend.jobs.redis.ping()
        if _redis_share(backend.jobs.redis) >= FULL_SHARE:
            return (
                f"Redis uses {FULL_SHARE:.0%} of the memory it may, and accepts no new work until results are deleted."
            )
        backend.spool.mkdir(parents=True, exist_ok=True)
        if not os.access(backend.spool, os.W_OK):
            return "The service cannot write to its data folder."
        if shutil.disk_usage(backend.spool).free < settings.min_free_bytes:
            return "The disk of the service is nearly full, and accepts no new work until files are deleted."
        backend.blobs.reach()
    except RedisError as error:
        return "The disk of Redis is full." if refuses_writes(error) else "The service cannot use Redis at the moment."
    except (OSError, StoreError):
        return "The service cannot use its store at the moment."
    return ""


def _redis_share(client: Redis) -> float:
    """The share of the memory that Redis may use; without a limit of its own, of its machine's."""
    memory = client.info("memory")
    most = memory.get("maxmemory") or memory.get("total_system_memory") or float("inf")
    return float(memory["used_memory"]) / float(most)


async def describe_unserved_queues(backend: Backend) -> str:
    """Which queues no worker takes from, as a sentence; what is posted meanwhile waits there. Empty where all do."""
    queues = await to_thread.run_sync(unserved_queues, backend.jobs.redis)
    return f"No worker is ready to take jobs from {' and '.join(queues)}." if queues else ""


async def require_capacity(request: Request, backend: BackendDependency) -> None:
    """Refuse new work while there is no capacity for it."""
    if request.method != "POST":
        return
    capacity: Capacity = request.app.state.capacity
    shortage = await capacity.shortage(backend)
    if shortage:
        raise RequestProblem("not-ready", f"{shortage} Nothing is stored; try again later.")
