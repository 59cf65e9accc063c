"""Takes that wait in a collection: measured as soon as each is analysed, and labelled by the motions that are known.

The first takes of a collection are cut together, once all of them are analysed. What is there already never changes.
"""

from collections.abc import Sequence

from caesura.core.together.take_labelling import label_take
from caesura.worker.collections.common_motions import add_motions, new_motion_id, new_motions
from caesura.worker.collections.joint_cut import collected_segments, cut_together
from caesura.worker.collections.known_motions import known_motions
from caesura.worker.collections.space_learning import delete_indices, learn_space_anew
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import put_index, read_measured
from caesura.worker.collections.take_measuring import failed_take, measure_ready, waiting_takes
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.queue.queues import TimeLimit
from caesura.worker.records.collection_types import CollectionRecord, TakeRecord
from caesura.worker.records.collections import CollectionChange


def label_waiting(here: WorkerContext, identifier: str) -> None:
    """Measure and label what is ready; returns once nothing more is."""
    while measure_ready(here, identifier) or _label_measured(here, identifier):
        continue
    learn_space_anew(here, identifier)


def _label_measured(here: WorkerContext, identifier: str) -> bool:
    """Label a take that waits and is measured, or cut the first ones together; whether there was any."""
    collections = here.jobs.records.collections
    record, waiting = collections.one(identifier), waiting_takes(here, identifier)
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
        delete_indices(here, change.put)
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
        return CollectionChange(record, (failed_take(take, fault, "labelled"),))
    names = {number: motion for motion, number in numbers.items()}
    names |= {number: new_motion_id() for number in update.new_motions}
    made = new_motions(record.motions, [names[number] for number in update.new_motions])
    segments = collected_segments(update.collection, take, names)
    labelled = _with_index(here, take.model_copy(update={"segments": segments}), record.space, stored)
    return CollectionChange(add_motions(record, made), (labelled,))


def _with_index(here: WorkerContext, take: TakeRecord, key: str, stored: StoredSpace) -> TakeRecord:
    numbers = put_index(here.blobs, take, key, stored)
    return take.model_copy(update={"status": "labelled", "problem": None, "numbers": numbers})
