"""The motions of a collection as the method has them: takes with their segments, and the signatures of these."""

from collections.abc import Iterable, Mapping

import numpy as np

from caesura.core.together.linkage import ALIKE
from caesura.core.together.motion_collection import CollectedSegment as CoreSegment
from caesura.core.together.motion_collection import CollectedTake, MotionCollection
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space import PoseSpace
from caesura.core.together.take_labelling import MOST_EXEMPLARS
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import read_signatures
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.records.collection_types import CollectionRecord, TakeRecord


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
