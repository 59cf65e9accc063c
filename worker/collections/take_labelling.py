"""Takes that wait in a collection: measured as soon as each is analysed, and labelled by the motions that are known.

The first takes of a collection are cut together, once all of them are analysed. What is there already never changes.
"""

import logging
import time
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from caesura.core.together.linkage import ALIKE
from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.motion_collection import CollectedSegment as CoreSegment
from caesura.core.together.motion_collection import CollectedTake, MotionCollection
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space import PoseSpace
from caesura.core.together.take_labelling import MOST_EXEMPLARS, label_take
from caesura.core.together.take_segments import sign_take
from caesura.worker.collections.common_motions import add_motions, new_motion_id, new_motions
from caesura.worker.collections.joint_cut import collected_segments, cut_together
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import as_labelled, measure, put_index, read_measured, read_signatures
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.queue.job_problems import GONE, INTERNAL_ERROR, problem_of
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records.collection_types import CollectionRecord, TakeNumbers, TakeRecord
from caesura.worker.records.collections import CollectionChange

log = logging.getLogger(__name__)

RELEARN = 2.0
"""The pose space is learned anew, and no label changes by that, once there are so many times the takes."""
LEARNED_ENOUGH = 40
"""Takes that a pose space is learned from for good: in a new one all are compared anew, and whoever adds one waits."""


def label_waiting(here: WorkerContext, identifier: str) -> None:
    """Measure and label what is ready; returns once nothing more is."""
    while _measure_ready(here, identifier) or _label_measured(here, identifier):
        continue
    _learn_space_anew(here, identifier)


def _waiting(here: WorkerContext, identifier: str) -> list[TakeRecord]:
    collections = here.jobs.records.collections
    entries = collections.entries(identifier)
    waiting = sorted((entry.added, name) for name, entry in entries.items() if entry.status == "waiting")
    return collections.takes(identifier, [name for _, name in waiting])


def _measure_ready(here: WorkerContext, identifier: str) -> bool:
    """Measure the takes that are analysed since the last look; whether there was any, or one that never will be."""
    done = False
    for take in _waiting(here, identifier):
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


def _failed(take: TakeRecord, fault: Exception, undone: str) -> TakeRecord:
    """The take with what is wrong with it; a bug is logged."""
    problem = problem_of(fault)
    if problem == INTERNAL_ERROR:
        log.error("%s cannot be %s", take.animation, undone, exc_info=fault)
    return take.model_copy(update={"status": "failed", "problem": problem})


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
        return _failed(take, fault, "measured")
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


def _label_measured(here: WorkerContext, identifier: str) -> bool:
    """Label a take that waits and is measured, or cut the first ones together; whether there was any."""
    collections = here.jobs.records.collections
    record, waiting = collections.one(identifier), _waiting(here, identifier)
    ready = [take for take in waiting if take.numbers is not None]
    if record is None or not ready:
        return False
    if record.space:
        change = _labelled(here, record, ready[0])
    elif len(ready) < len(waiting):
        return False  # the first ones are cut together, once all are measured
    else:
        change = _cut_first(here, record, ready)
    version = record.version
    kept = collections.change(identifier, lambda now: change if now.version == version else None)
    if kept is None:  # it was changed meanwhile: look again
        _delete_indices(here, change.put)
        if change.record.space != record.space:
            here.blobs.delete(change.record.space)
    return True


def _cut_first(here: WorkerContext, record: CollectionRecord, takes: Sequence[TakeRecord]) -> CollectionChange:
    """The first takes of a collection, cut together."""
    found = cut_together([read_measured(here.blobs, take) for take in takes], record.asked)
    identifiers = {motion: new_motion_id() for motion in found.collection.motion_ids}
    key = here.blobs.put(found.space.to_bytes(), "collections")
    put = []
    for take in takes:
        if take.animation in found.refused:
            put.append(take.model_copy(update={"status": "failed", "problem": found.refused[take.animation]}))
            continue
        segments = collected_segments(found.collection, take, identifiers)
        put.append(_with_index(here, take.model_copy(update={"segments": segments}), key, found.space))
    made = new_motions(record.motions, identifiers.values())
    with_motions = add_motions(record, made)
    return CollectionChange(with_motions.model_copy(update={"space": key, "learned": len(put)}), tuple(put))


def _labelled(here: WorkerContext, record: CollectionRecord, take: TakeRecord) -> CollectionChange:
    """A further take, labelled by what is known; its own motions that are none of them are new ones."""
    stored = StoredSpace.from_bytes(here.blobs.read(record.space))
    numbers = {motion.id: number for number, motion in enumerate(record.motions)}
    known = known_motions(here, record, stored, numbers)
    try:
        update = label_take(known, read_measured(here.blobs, take))
    except TimeLimit:
        raise
    except Exception as fault:  # noqa: BLE001  said of the take; a bug is logged
        return CollectionChange(record, (_failed(take, fault, "labelled"),))
    names = {number: motion for motion, number in numbers.items()}
    names |= {number: new_motion_id() for number in update.new_motions}
    made = new_motions(record.motions, [names[number] for number in update.new_motions])
    segments = collected_segments(update.collection, take, names)
    labelled = _with_index(here, take.model_copy(update={"segments": segments}), record.space, stored)
    return CollectionChange(add_motions(record, made), (labelled,))


def _with_index(here: WorkerContext, take: TakeRecord, key: str, stored: StoredSpace) -> TakeRecord:
    numbers = put_index(here.blobs, take, key, stored)
    return take.model_copy(update={"status": "labelled", "problem": None, "numbers": numbers})


def known_motions(
    here: WorkerContext, record: CollectionRecord, stored: StoredSpace, numbers: Mapping[str, int]
) -> MotionCollection:
    """The motions of a collection by a few segments of each, of as many takes as can be: few takes are read."""
    entries = here.jobs.records.collections.entries(record.id)
    chosen: dict[str, set[str]] = {}
    for motion in numbers:
        having = sorted(name for name, entry in entries.items() if motion in entry.motions)
        for name in having[:: max(len(having) // MOST_EXEMPLARS, 1)][:MOST_EXEMPLARS]:
            chosen.setdefault(name, set()).add(motion)
    takes = here.jobs.records.collections.takes(record.id, chosen)
    return collection_of(here, takes, stored, numbers, chosen)


def collection_of(
    here: WorkerContext,
    takes: Iterable[TakeRecord],
    stored: StoredSpace,
    numbers: Mapping[str, int],
    chosen: Mapping[str, set[str]] | None = None,
) -> MotionCollection:
    """Takes with their segments as the method has them, motions by number; of some takes only `chosen` motions.

    A take whose numbers are no longer kept is left out.
    """
    kept: list[TakeRecord] = []
    segments: list[CoreSegment] = []
    parts: list[MotionSignatures] = []
    for take in takes:
        if take.numbers is None:
            continue
        signatures = read_signatures(here.blobs, take, stored)
        wanted = [
            i for i, one in enumerate(take.segments) if chosen is None or one.motion in chosen.get(take.animation, ())
        ]
        kept.append(take)
        parts.append(signatures[np.array(wanted, np.int64)])
        segments += [_core_segment(take, i, numbers) for i in wanted]
    return MotionCollection(
        space=stored.space,
        takes=tuple(CollectedTake(take.animation, take.frames, take.frame_rate) for take in kept),
        segments=tuple(segments),
        signatures=MotionSignatures.joined(parts) if parts else _no_signatures(stored.space),
        names=(),
        spreads=stored.spreads,
        alike=ALIKE,
        next_id=len(numbers),
    )


def _core_segment(take: TakeRecord, at: int, numbers: Mapping[str, int]) -> CoreSegment:
    one = take.segments[at]
    motion = numbers[one.motion]
    seconds = (one.end - one.start) / take.frame_rate
    return CoreSegment(take.animation, one.start, one.end, seconds, motion, motion, fixed=one.corrected)


def _no_signatures(space: PoseSpace) -> MotionSignatures:
    size = space.directions.shape[1]
    roots = np.zeros((0, size, size), np.float32)
    return MotionSignatures(np.zeros((0, size), np.float32), roots, roots)


def _learn_space_anew(here: WorkerContext, identifier: str) -> None:
    """Learn the pose space of all takes, once there are many more than it was learned from; no label changes."""
    collections = here.jobs.records.collections
    record = collections.one(identifier)
    if record is None or not record.space or record.learned >= LEARNED_ENOUGH:
        return
    takes = labelled_takes(here, identifier)
    if len(takes) < RELEARN * record.learned:
        return
    relearn_space(here, record, takes)


def labelled_takes(here: WorkerContext, identifier: str) -> list[TakeRecord]:
    """The takes of a collection that are labelled, and whose numbers are kept."""
    takes = here.jobs.records.collections.all_takes(identifier)
    return [take for take in takes if take.status == "labelled" and take.numbers is not None]


def relearn_space(here: WorkerContext, record: CollectionRecord, takes: Sequence[TakeRecord]) -> None:
    """Compare all takes in a space that is learned from all of them."""
    measured = [read_measured(here.blobs, take) for take in takes]
    space = PoseSpace.learn([(one.name, one.poses) for one in measured])
    signed = [_signed(space, one, take) for one, take in zip(measured, takes, strict=True)]
    stored = StoredSpace(space, MotionSignatures.joined(signed).spreads())
    key = here.blobs.put(stored.to_bytes(), "collections")
    put = tuple(take.model_copy(update={"numbers": put_index(here.blobs, take, key, stored)}) for take in takes)
    changed = record.model_copy(update={"space": key, "learned": len(takes), "updated": time.time()})
    version = record.version
    change = CollectionChange(changed, put)
    kept = here.jobs.records.collections.change(record.id, lambda now: change if now.version == version else None)
    _delete_indices(here, put if kept is None else takes)
    here.blobs.delete(key if kept is None else record.space)


def _signed(space: PoseSpace, measured: MeasuredTake, take: TakeRecord) -> MotionSignatures:
    return sign_take(space, as_labelled(measured, take))


def _delete_indices(here: WorkerContext, takes: Iterable[TakeRecord]) -> None:
    """Delete what takes are compared by in a space that is not, or no longer, theirs."""
    for take in takes:
        if take.numbers is not None:
            for key in (take.numbers.signatures, take.numbers.searched):
                if key is not None:
                    here.blobs.delete(key)
