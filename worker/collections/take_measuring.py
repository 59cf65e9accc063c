"""Takes that wait in a collection, measured as soon as each is analysed."""

import logging
from collections.abc import Sequence

from caesura.worker.collections.take_files import measure
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.queue.job_problems import GONE, INTERNAL_ERROR, problem_of
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records.collection_types import CollectionRecord, TakeNumbers, TakeRecord
from caesura.worker.records.collections import CollectionChange
from caesura.worker.records.record_types import SegmentationRecord

log = logging.getLogger(__name__)


MEASURED_AT_ONCE = 16
"""Takes whose numbers are kept in one go: waiting for the disk, and changing the collection, take their time."""

Measured = tuple[TakeRecord, bytes | None]
"""A take, and its poses with its own cut; none where it has failed."""


def measure_ready(here: WorkerContext, identifier: str, waiting: Sequence[TakeRecord]) -> bool:
    """Measure those of the takes that are analysed; whether there was any, or one that never will be."""
    done, measured = False, list[Measured]()
    for take in waiting:
        segmentation = here.jobs.records.segmentations.one(take.segmentation)
        if take.numbers is not None or (segmentation is not None and segmentation.live):
            continue
        measured.append(_measured(here, take, segmentation))
        done = True
        if len(measured) == MEASURED_AT_ONCE:
            _put_measured(here, identifier, measured)
            measured = []
    if measured:
        _put_measured(here, identifier, measured)
    return done


def _measured(here: WorkerContext, take: TakeRecord, segmentation: SegmentationRecord | None) -> Measured:
    """The take as it is compared, or failed."""
    if segmentation is None or segmentation.status != "done":
        problem = (segmentation.problem if segmentation is not None else None) or GONE
        return take.model_copy(update={"status": "failed", "problem": problem}), None
    quota = JobQuota(here.settings.job_memory_bytes, here.settings.job_seconds)
    try:
        measured, begin = measure(here, quota, segmentation)
    except TimeLimit:
        raise
    except Exception as fault:  # noqa: BLE001  said of the take; a bug is logged
        return failed_take(take, fault, "measured"), None
    poses = measured.poses
    timing = {"frames": poses.frames, "frame_rate": poses.frame_rate, "begin": begin}
    return take.model_copy(update=timing), measured.to_bytes()


def _put_measured(here: WorkerContext, identifier: str, measured: Sequence[Measured]) -> None:
    """Keep what was measured of takes that still wait; forget the rest."""
    collections = here.jobs.records.collections
    keys = iter(here.blobs.put_all([poses for _, poses in measured if poses is not None], "collections"))
    takes = [
        take if poses is None else take.model_copy(update={"numbers": TakeNumbers(poses=next(keys))})
        for take, poses in measured
    ]
    names = [take.animation for take in takes]

    def change(record: CollectionRecord) -> CollectionChange | None:
        kept = {take.animation: take for take in collections.takes(identifier, names)}
        waiting = {name for name, take in kept.items() if take.status == "waiting" and take.numbers is None}
        wanted = tuple(take for take in takes if take.animation in waiting)
        return CollectionChange(record, wanted) if wanted else None

    collections.change(identifier, change)
    kept = {take.numbers.poses for take in collections.takes(identifier, names) if take.numbers is not None}
    for take in takes:
        if take.numbers is not None and take.numbers.poses not in kept:
            here.blobs.delete(take.numbers.poses)


def waiting_takes(here: WorkerContext, identifier: str) -> tuple[CollectionRecord, list[TakeRecord]] | None:
    """The collection, and its takes that are not labelled yet in the order of their addition; None where none is."""
    collections = here.jobs.records.collections
    record = collections.one(identifier)
    if record is None or not record.waiting:
        return None
    entries = collections.entries(identifier)
    waiting = sorted((entry.added, name) for name, entry in entries.items() if entry.status == "waiting")
    return record, collections.takes(identifier, [name for _, name in waiting])


def failed_take(take: TakeRecord, fault: Exception, undone: str) -> TakeRecord:
    """The take with what is wrong with it; a bug is logged."""
    problem = problem_of(fault)
    if problem == INTERNAL_ERROR:
        log.error("%s cannot be %s", take.animation, undone, exc_info=fault)
    return take.model_copy(update={"status": "failed", "problem": problem})
