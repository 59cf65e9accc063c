"""Jobs that are no segmentation: a file of a result, the other numbers of motions, a look for what is kept too long."""

import time

from redis import WatchError

from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import content_ids, redis_keys
from caesura.worker.records.schema import ExportRecord

SWEEP_SECONDS = 3600
PROBLEM_SECONDS = 10.0

DELETED = {"kind": "request", "code": "not-found", "detail": "The segmentation was deleted meanwhile."}


def submit_export(jobs: Jobs, identifier: str, form: str) -> ExportRecord:
    """Have a file made of a result that is done, unless it is there or being made; see `ResultFiles.one`."""
    key = redis_keys.export_key(identifier, form)
    with jobs.redis.pipeline() as pipe:
        while True:
            pipe.watch(key, redis_keys.segmentation_key(identifier))
            kept = jobs.records.exports.one(identifier, form)
            if kept is not None and _holds(jobs, kept):
                return kept
            if not pipe.exists(redis_keys.segmentation_key(identifier)):
                return ExportRecord(problem=DELETED)
            jobs.queues.check_room()
            pending = ExportRecord(token=content_ids.token())
            pipe.multi()
            pipe.set(key, pending.model_dump_json(), ex=2 * jobs.job_seconds)
            pipe.sadd(redis_keys.exports_key(identifier), form)
            jobs.records.attempts.renew(pending.token, pipe)
            jobs.queues.put("cut", "export", [identifier, form], pending.token, jobs.job_seconds, pipe)
            try:
                pipe.execute()
            except WatchError:  # somebody else asked for it in this moment, or deleted it
                continue
            return pending


def _holds(jobs: Jobs, export: ExportRecord) -> bool:
    """Whether there is a file, or a reason why there is none; or whether its job waits or runs.

    A reason that is not the file's holds for as long as it takes everybody who waits to hear it.
    """
    if export.pending:
        return jobs.records.attempts.leased(export.token) or jobs.queues.waits("cut", export.token)
    passing = (export.problem or {}).get("kind") == "worker"
    return not passing or abs(time.time() - export.created) < PROBLEM_SECONDS


def submit_alternatives(jobs: Jobs, identifier: str) -> None:
    """Have the other numbers of motions worked out that a result has scored, when the takes before it are done."""
    with jobs.redis.pipeline() as pipe:
        jobs.queues.put("analyse", "alternatives", [identifier], content_ids.token(), jobs.job_seconds, pipe)
        pipe.execute()


def submit_sweep_if_due(jobs: Jobs) -> None:
    """Queue a look for what is kept too long, where nobody has within the last hour. Call it at any time."""
    if jobs.redis.set(redis_keys.LAST_SWEEP_KEY, b"1", nx=True, ex=SWEEP_SECONDS):
        with jobs.redis.pipeline() as pipe:
            jobs.queues.put("cut", "sweep", [], content_ids.token(), SWEEP_SECONDS, pipe)
            pipe.execute()
    elif jobs.redis.ttl(redis_keys.LAST_SWEEP_KEY) > SWEEP_SECONDS:  # Redis's clock was ahead when it was set
        jobs.redis.expire(redis_keys.LAST_SWEEP_KEY, SWEEP_SECONDS)
