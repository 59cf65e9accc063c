"""Takes that wait in a collection: measured as soon as each is analysed, and labelled by the motions that are known.

The first takes of a collection are cut together, once all of them are analysed. What is there already never changes.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.motion_collection import MotionCollection
from caesura.core.together.take_labelling import label_take
from caesura.worker.collections.common_motions import add_motions, new_motion_id, new_motions
from caesura.worker.collections.joint_cut import collected_segments, cut_together
from caesura.worker.collections.known_motions import known_motions
from caesura.worker.collections.space_learning import delete_indices, learn_space_anew
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import put_indices, read_measured
from caesura.worker.collections.take_measuring import failed_take, measure_ready, waiting_takes
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records.collection_types import CollectionRecord, TakeRecord
from caesura.worker.records.collections import CollectionChange


def label_waiting(here: WorkerContext, identifier: str) -> None:
    """Measure and label what is ready; returns once nothing more is."""
    while (found := waiting_takes(here, identifier)) is not None:
        if not measure_ready(here, identifier, found[1]) and not _label_measured(here, *found):
            break
    learn_space_anew(here, identifier)


def _label_measured(here: WorkerContext, record: CollectionRecord, waiting: Sequence[TakeRecord]) -> bool:
    """Label a take that waits and is measured, or cut the first ones together; whether there was any."""
    ready = [take for take in waiting if take.numbers is not None]
    if not ready:
        return False
    if record.space:
        change = _labelled(here, record, ready[0])
    elif len(ready) < len(waiting):
        return False  # the first ones are cut together, once all are measured
    else:
        change = _cut_first(here, record, ready)
    version = record.version
    kept = here.jobs.records.collections.change(record.id, lambda now: change if now.version == version else None)
    if kept is None:  # it was changed meanwhile: look again
        delete_indices(here, change.put)
        if change.record.space != record.space:
            here.blobs.delete(change.record.space)
    return True


def _cut_first(here: WorkerContext, record: CollectionRecord, takes: Sequence[TakeRecord]) -> CollectionChange:
    """The first takes of a collection, cut together."""
    measured = {take.animation: read_measured(here.blobs, take) for take in takes}
    found = cut_together(list(measured.values()), record.asked)
    refused = [
        take.model_copy(update={"status": "failed", "problem": found.refused[take.animation]})
        for take in takes
        if take.animation in found.refused
    ]
    fitting = [take for take in takes if take.animation not in found.refused]
    identifiers = {motion: new_motion_id() for motion in found.collection.motion_ids}
    key = here.blobs.put(found.space.to_bytes(), "collections")
    put = _labelled_as(
        here, fitting, [measured[take.animation] for take in fitting], found.collection, identifiers, key
    )
    with_motions = add_motions(record, new_motions(record.motions, identifiers.values()))
    learned = with_motions.model_copy(update={"space": key, "learned": len(takes)})
    return CollectionChange(learned, (*put, *refused))


def _labelled(here: WorkerContext, record: CollectionRecord, take: TakeRecord) -> CollectionChange:
    """A further take, labelled by what is known; its own motions that are none of them are new ones."""
    stored = StoredSpace.from_bytes(here.blobs.read(record.space))
    numbers = {motion.id: number for number, motion in enumerate(record.motions)}
    known = known_motions(here, record, stored, numbers)
    try:
        measured = read_measured(here.blobs, take)
        update = label_take(known, measured)
    except TimeLimit:
        raise
    except Exception as fault:  # noqa: BLE001  said of the take; a bug is logged
        return CollectionChange(record, (failed_take(take, fault, "labelled"),))
    names = {number: motion for motion, number in numbers.items()}
    names |= {number: new_motion_id() for number in update.new_motions}
    made = new_motions(record.motions, [names[number] for number in update.new_motions])
    put = _labelled_as(here, [take], [measured], update.collection, names, record.space)
    return CollectionChange(add_motions(record, made), put)


def _labelled_as(
    here: WorkerContext,
    takes: Sequence[TakeRecord],
    measured: Sequence[MeasuredTake],
    collection: MotionCollection,
    names: Mapping[int, str],
    key: str,
) -> tuple[TakeRecord, ...]:
    """The takes with their segments in the motions of a collection, and with what they are compared by."""
    segments = collected_segments(collection, takes, names)
    rows: dict[str, list[int]] = {take.animation: [] for take in takes}
    for row, one in enumerate(collection.segments):
        if one.take in rows:
            rows[one.take].append(row)
    labelled = [
        take.model_copy(update={"status": "labelled", "problem": None, "segments": segments[take.animation]})
        for take in takes
    ]
    signatures = [collection.signatures[np.array(rows[take.animation], np.int64)] for take in takes]
    return tuple(put_indices(here.blobs, labelled, measured, signatures, (key, collection.space)))
