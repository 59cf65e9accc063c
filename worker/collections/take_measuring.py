"""Takes that wait in a collection, measured as soon as each is analysed."""

import logging

from caesura.worker.collections.take_files import measure
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.queue.job_problems import GONE, INTERNAL_ERROR, problem_of
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records.collection_types import CollectionRecord, TakeNumbers, TakeRecord
from caesura.worker.records.collections import CollectionChange

log = logging.getLogger(__name__)


def measure_ready(here: WorkerContext, identifier: str) -> bool:
    """Measure the takes that are analysed since the last look; whether there was any, or one that never will be."""
    done = False
    for take in waiting_takes(here, identifier):
        segmentation = here.jobs.records.segmentations.one(take.segmentation)
        if take.numbers is not None or (segmentation is not None and segmentation.live):
            continue
        if segmentation is None or segmentation.status != "done":
            problem = (segmentation.problem if segmentation is not None else None) or GONE
            measured = take.model_copy(update={"status": "failed", "problem": problem})
        else:
            measured = _measured(here, take)
        _put_waiting(here, identifier, measured)
        done = True
    return done


def _measured(here: WorkerContext, take: TakeRecord) -> TakeRecord:
    """The take with its numbers, or failed."""
    segmentation = here.jobs.records.segmentations.one(take.segmentation)
    quota = JobQuota(here.settings.job_memory_bytes, here.settings.job_seconds)
    try:
        if segmentation is None:
            return take.model_copy(update={"status": "failed", "problem": GONE})
        measured, begin = measure(here, quota, segmentation)
    except TimeLimit:
        raise
    except Exception as fault:  # noqa: BLE001  said of the take; a bug is logged
        return failed_take(take, fault, "measured")
    key = here.blobs.put(measured.to_bytes(), "collections")
    return take.model_copy(
        update={
            "numbers": TakeNumbers(poses=key),
            "frames": measured.poses.frames,
            "frame_rate": measured.poses.frame_rate,
            "begin": begin,
        }
    )


def _put_waiting(here: WorkerContext, identifier: str, take: TakeRecord) -> None:
    """Keep what was measured of a take that still waits; else forget it."""
    collections = here.jobs.records.collections

    def change(record: CollectionRecord) -> CollectionChange | None:
        kept = next(iter(collections.takes(identifier, [take.animation])), None)
        wanted = kept is not None and kept.status == "waiting" and kept.numbers is None
        return CollectionChange(record, (take,)) if wanted else None

    if collections.change(identifier, change) is None and take.numbers is not None:
        here.blobs.delete(take.numbers.poses)


def waiting_takes(here: WorkerContext, identifier: str) -> list[TakeRecord]:
    """The takes that are not labelled yet, in the order in which they were added."""
    collections = here.jobs.records.collections
    entries = collections.entries(identifier)
    waiting = sorted((entry.added, name) for name, entry in entries.items() if entry.status == "waiting")
    return collections.takes(identifier, [name for _, name in waiting])


def failed_take(take: TakeRecord, fault: Exception, undone: str) -> TakeRecord:
    """The take with what is wrong with it; a bug is logged."""
    problem = problem_of(fault)
    if problem == INTERNAL_ERROR:
        log.error("%s cannot be %s", take.animation, undone, exc_info=fault)
    return take.model_copy(update={"status": "failed", "problem": problem})
