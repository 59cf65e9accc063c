"""Problems of a job that the file does not cause."""

from typing import Any

from obstore.exceptions import BaseError as StoreError
from redis.exceptions import RedisError

from caesura.core.errors import CaesuraError
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.store.blobs import BlobMissing
from caesura.worker.store.disk_space import FULL, storage_full_error

INFRASTRUCTURE = (OSError, RedisError, StoreError)


def worker_problem(code: str, detail: str, **where: Any) -> dict[str, Any]:
    """A problem that is not the file's: posting the same again starts anew."""
    return {"kind": "worker", "code": code, "detail": detail, **where}


OUT_OF_MEMORY = worker_problem(
    "out-of-memory",
    "This take needs more memory than a job may use here. Send a smaller mesh or a shorter take, or ask the operator "
    "of this service to raise CAESURA_JOB_MEMORY_BYTES.",
    setting="CAESURA_JOB_MEMORY_BYTES",
)
OUT_OF_TIME = worker_problem(
    "out-of-time",
    "This take needs more time than a job may use here. Send a shorter take or a lower fps, or ask the operator of "
    "this service to raise CAESURA_JOB_SECONDS.",
    setting="CAESURA_JOB_SECONDS",
)
KILLED = worker_problem(
    "worker-killed", "The process that worked on this was killed, most likely because the machine ran out of memory."
)
LOST = worker_problem("worker-lost", "The worker was lost while it worked on this. Please try again.")
UNAVAILABLE = worker_problem(
    "storage-unavailable",
    "The service could not reach its store or its queue. Nothing is wrong with the file; try again.",
)
DELETED = worker_problem("animation-deleted", "The animation was deleted before it was analysed. Upload it again.")
INTERNAL_ERROR = worker_problem(
    "internal-error", "Something went wrong that is not the file's fault; the service's log has the details."
)
GONE = worker_problem("gone", "The upload is no longer kept here: its time has run out. Upload it again.")


def problem_of(fault: BaseException) -> dict[str, Any]:
    """What is said of a file that could not be made of a result; `INTERNAL_ERROR` is a bug."""
    if isinstance(fault, CaesuraError):
        return fault.problem()
    if isinstance(fault, OSError) and fault.errno in FULL:
        return storage_full_error().problem()
    if isinstance(fault, INFRASTRUCTURE):
        return UNAVAILABLE
    known = {BlobMissing: GONE, MemoryError: OUT_OF_MEMORY, TimeLimit: OUT_OF_TIME}
    return next((problem for kind, problem in known.items() if isinstance(fault, kind)), INTERNAL_ERROR)
