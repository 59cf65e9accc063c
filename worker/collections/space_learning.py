"""The pose space of a collection, learned anew of all takes once there are many more; no label changes by that."""

import time
from collections.abc import Iterable, Sequence

from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space import PoseSpace
from caesura.core.together.take_segments import sign_take
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import as_labelled, put_indices, read_measured
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.records.collection_types import CollectionRecord, TakeRecord
from caesura.worker.records.collections import CollectionChange

RELEARN = 2.0
"""The pose space is learned anew, and no label changes by that, once there are so many times the takes."""
LEARNED_ENOUGH = 40
"""Takes that a pose space is learned from for good: in a new one all are compared anew, and whoever adds one waits."""


def learn_space_anew(here: WorkerContext, identifier: str) -> None:
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
    pairs = zip(measured, takes, strict=True)
    signatures = [sign_take(space, as_labelled(one, take)) for one, take in pairs]
    stored = StoredSpace(space, MotionSignatures.joined(signatures).spreads())
    key = here.blobs.put(stored.to_bytes(), "collections")
    put = tuple(put_indices(here.blobs, takes, measured, signatures, (key, space)))
    changed = record.model_copy(update={"space": key, "learned": len(takes), "updated": time.time()})
    version = record.version
    change = CollectionChange(changed, put)
    kept = here.jobs.records.collections.change(record.id, lambda now: change if now.version == version else None)
    delete_indices(here, put if kept is None else takes)
    here.blobs.delete(key if kept is None else record.space)


def delete_indices(here: WorkerContext, takes: Iterable[TakeRecord]) -> None:
    """Delete what takes are compared by in a space that is not, or no longer, theirs."""
    for take in takes:
        if take.numbers is not None:
            for key in (take.numbers.signatures, take.numbers.searched):
                if key is not None:
                    here.blobs.delete(key)
