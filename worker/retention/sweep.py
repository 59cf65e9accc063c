"""The sweep: deletes uploads and analyses by their last use, and results by their age."""

import logging
import math
import time

from redis import Redis
from redis.exceptions import ResponseError

from caesura.worker.clock_check import is_clock_steady
from caesura.worker.queue.auxiliary_jobs import SWEEP_SECONDS
from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import redis_keys
from caesura.worker.records.record_types import AnimationRecord
from caesura.worker.retention.deletion import delete_collection, delete_segmentation, delete_upload_files
from caesura.worker.retention.orphaned_blobs import delete_orphaned_blobs
from caesura.worker.store.blobs import Blobs

log = logging.getLogger(__name__)

DOUBT_SECONDS = 3600.0
"""A blob that no record points to may be a job's that is not done yet; see `orphaned_blobs`."""


def sweep_by_clock(jobs: Jobs, blobs: Blobs, keep_upload: float, keep_result: float, now: float) -> None:
    """`sweep` where the clock can be trusted, else only count; and have the names of what was deleted forgotten."""
    if is_clock_steady(jobs.redis, max(min(keep_upload, keep_result) / 2, 2 * SWEEP_SECONDS), now):
        sweep(jobs, blobs, keep_upload, keep_result, now=now)
    else:
        delete_orphaned_blobs(jobs.records, blobs, math.inf)
    rewrite_append_only_file(jobs.redis)


def sweep(
    jobs: Jobs,
    blobs: Blobs,
    keep_upload: float,
    keep_result: float,
    doubt_seconds: float = DOUBT_SECONDS,
    now: float | None = None,
) -> None:
    """Forget uploads and analyses unused for `keep_upload` seconds, results and collections that nothing has changed
    for `keep_result` seconds, and orphans.

    What is queued or running keeps its upload. A record goes with the last thing that it is the record of.
    """
    now = time.time() if now is None else now
    for identifier, used in jobs.records.animations.uses().items():
        animation = jobs.records.animations.one(identifier)
        if animation is not None:
            _sweep_animation(jobs, blobs, animation, used < now - keep_upload, now - keep_result)
    for identifier in jobs.records.collections.all():
        collection = jobs.records.collections.one(identifier)
        if collection is not None and collection.updated < now - keep_result:
            delete_collection(jobs, blobs, collection)
    delete_orphaned_blobs(jobs.records, blobs, doubt_seconds)


def _sweep_animation(jobs: Jobs, blobs: Blobs, animation: AnimationRecord, unused: bool, oldest: float) -> None:
    cuts = jobs.records.segmentations.of(animation.id)
    for cut in cuts:
        jobs.records.segmentations.index(cut)
    outdated = [cut for cut in cuts if not cut.live and cut.updated < oldest]
    for cut in outdated:
        delete_segmentation(jobs, blobs, cut.id)
    if not unused or any(cut.live for cut in cuts):
        return
    delete_upload_files(jobs, blobs, animation)
    if not jobs.records.animations.delete(animation):
        jobs.records.animations.strip(animation)


def rewrite_append_only_file(client: Redis) -> None:
    """Have Redis write its file anew where something was deleted: what was written before stays in the old one."""
    if not client.info("persistence").get("aof_enabled") or not client.delete(redis_keys.DELETED_KEY):
        return
    try:
        client.bgrewriteaof()
    except ResponseError as refused:  # another one is under way, or this Redis does not let us
        client.set(redis_keys.DELETED_KEY, b"1")
        log.warning(
            "Redis does not rewrite its append-only file now, and the names of deleted data stay in it: %s", refused
        )
