"""Jobs that are no segmentation: files of a result, loops of edited segments, other numbers of motions, a clean-up."""

import time
from collections.abc import Sequence

from redis.client import Pipeline

from caesura.core.revision import Edit
from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import content_ids, redis_keys
from caesura.worker.records.connection import transact
from caesura.worker.records.record_types import ExportRecord
from caesura.worker.records.revisions import EDITS

SWEEP_SECONDS = 3600
PROBLEM_SECONDS = 10.0

DELETED = {"kind": "request", "code": "not-found", "detail": "The segmentation was deleted meanwhile."}


def submit_export(jobs: Jobs, identifier: str, form: str) -> ExportRecord:
    """Have a file made of a result that is done, unless it is there or being made; see `ResultFiles.one`."""
    key = redis_keys.export_key(identifier, form)

    def submit(pipe: Pipeline) -> ExportRecord:
        kept = jobs.records.exports.one(identifier, form)
        exists = pipe.exists(redis_keys.segmentation_key(identifier))
        pipe.multi()
        if kept is not None and _has_pending_export(jobs, kept):
            return kept
        if not exists:
            return ExportRecord(problem=DELETED)
        jobs.queues.check_room()
        pending = ExportRecord(token=content_ids.random_token())
        pipe.set(key, pending.model_dump_json(), ex=2 * jobs.job_seconds)
        pipe.sadd(redis_keys.exports_key(identifier), form)
        jobs.records.attempts.renew(pending.token, pipe)
        jobs.queues.put("cut", "export", [identifier, form], pending.token, jobs.job_seconds, pipe)
        return pending

    watched = (key, redis_keys.segmentation_key(identifier))  # others may ask for it in this moment, or delete it
    return transact(jobs.redis, submit, *watched)


def _has_pending_export(jobs: Jobs, export: ExportRecord) -> bool:
    """Whether there is a file, or a reason why there is none; or whether its job waits or runs.

    A reason that is not the file's holds for as long as it takes everybody who waits to hear it.
    """
    if export.pending:
        return jobs.records.attempts.leased(export.token) or jobs.queues.is_waiting("cut", export.token)
    passing = (export.problem or {}).get("kind") == "worker"
    return not passing or abs(time.time() - export.created) < PROBLEM_SECONDS


def submit_loop_search(jobs: Jobs, identifier: str, edits: Sequence[Edit]) -> str:
    """Have the best loops of edited segments searched; answers the token of `Revisions.searched_loops`.

    Raises `QueueFull` where too many jobs wait.
    """
    jobs.queues.check_room()
    token = content_ids.random_token()
    with jobs.redis.pipeline() as pipe:
        jobs.queues.put(
            "cut", "loops", [identifier, token, EDITS.dump_json(tuple(edits)).decode()], token, jobs.job_seconds, pipe
        )
        pipe.execute()
    return token


def submit_alternatives(jobs: Jobs, identifier: str) -> None:
    """Have the other numbers of motions worked out that a result has scored, when the takes before it are done."""
    with jobs.redis.pipeline() as pipe:
        jobs.queues.put("analyse", "alternatives", [identifier], content_ids.random_token(), jobs.job_seconds, pipe)
        pipe.execute()


def submit_sweep_if_due(jobs: Jobs) -> None:
    """Queue a look for what is kept too long, where nobody has within the last hour. Call it at any time."""
    if jobs.redis.set(redis_keys.LAST_SWEEP_KEY, b"1", nx=True, ex=SWEEP_SECONDS):
        with jobs.redis.pipeline() as pipe:
            jobs.queues.put("cut", "sweep", [], content_ids.random_token(), SWEEP_SECONDS, pipe)
            pipe.execute()
    elif jobs.redis.ttl(redis_keys.LAST_SWEEP_KEY) > SWEEP_SECONDS:  # Redis's clock was ahead when it was set
        jobs.redis.expire(redis_keys.LAST_SWEEP_KEY, SWEEP_SECONDS)
