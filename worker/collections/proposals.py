"""Proposals: a new cut of all takes, or what a correction says of the others. Nothing of them holds before a person
accepts them, and what people have corrected stays."""

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment

from caesura.core.together.corrections import correct_segment
from caesura.core.together.motion_collection import MotionCollection
from caesura.worker.collections.common_motions import new_motion_id, new_motions
from caesura.worker.collections.corrected_takes import changed_frames, lay_around_corrections
from caesura.worker.collections.joint_cut import collected_segments, cut_together
from caesura.worker.collections.known_motions import collection_of
from caesura.worker.collections.space_learning import labelled_takes
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.collections.take_files import read_measured
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.records.collection_types import (
    CollectedSegment,
    CollectionRecord,
    ProposalRecord,
    TakeChange,
    TakeRecord,
)


def work_out(here: WorkerContext, record: CollectionRecord, proposal: ProposalRecord) -> ProposalRecord:
    """The proposal with its changes: open, or empty where it would change nothing."""
    takes = labelled_takes(here, record.id)
    work = _recut if proposal.kind == "recut" else _learned
    after, identifiers = work(here, record, proposal, takes)
    changes = [_change(take, after[take.animation]) for take in takes if take.animation in after]
    made = tuple(change for change in changes if change.changed_seconds > 0)
    motions = tuple(new_motions(record.motions, identifiers))
    used = {segment.motion for change in made for segment in change.segments}
    return proposal.model_copy(
        update={
            "status": "open" if made else "empty",
            "changes": made,
            "motions": tuple(motion for motion in motions if motion.id in used),
        }
    )


Segments = Mapping[str, Sequence[CollectedSegment]]
"""Of takes, by animation."""


def _recut(
    here: WorkerContext, record: CollectionRecord, proposal: ProposalRecord, takes: Sequence[TakeRecord]
) -> tuple[Segments, list[str]]:
    """All takes cut together anew. A motion found is the one of the collection that it shares the most time with."""
    if not takes:
        return {}, []
    found = cut_together([read_measured(here.blobs, take) for take in takes], proposal.asked)
    names = _matched(found.collection, takes, [motion.id for motion in record.motions])
    known = {motion.id for motion in record.motions}
    segments = collected_segments(found.collection, takes, names)
    after = {
        take.animation: lay_around_corrections(take, segments[take.animation])
        for take in takes
        if take.animation not in found.refused
    }
    return after, [name for name in names.values() if name not in known]


def _matched(collection: MotionCollection, takes: Sequence[TakeRecord], known: Sequence[str]) -> dict[int, str]:
    """An id for each motion found: one to one, and with the most seconds in common."""
    rows, columns = {m: i for i, m in enumerate(collection.motion_ids)}, {m: i for i, m in enumerate(known)}
    shared = np.zeros((len(rows), len(columns)))
    by_take = {take.animation: take for take in takes}
    for one in collection.segments:
        take = by_take[one.take]
        for other in take.segments:
            frames = min(one.end, other.end) - max(one.start, other.start)
            if frames > 0 and other.motion in columns:
                shared[rows[one.motion], columns[other.motion]] += frames / take.frame_rate
    pairs = {int(i): known[j] for i, j in zip(*linear_sum_assignment(-shared), strict=True) if shared[i, j] > 0}
    return {motion: pairs.get(row) or new_motion_id() for motion, row in rows.items()}


def _learned(
    here: WorkerContext, record: CollectionRecord, proposal: ProposalRecord, takes: Sequence[TakeRecord]
) -> tuple[Segments, list[str]]:
    """What the corrected segments of a take say of those of others that are of the motions they were of."""
    source = next((take for take in takes if take.animation == proposal.animation), None)
    if source is None:
        return {}, []
    corrected = [one for one in source.segments if one.corrected and one.left and one.left != one.motion]
    left = {one.left for one in corrected}
    known = {motion.id for motion in record.motions}
    numbers = {motion: number for number, motion in enumerate([*known, *sorted(left - known)])}
    before = {(one.start, one.end): one.left for one in corrected}
    as_it_was = source.model_copy(
        update={
            "segments": tuple(
                one.model_copy(update={"motion": before.get((one.start, one.end), one.motion)})
                for one in source.segments
            )
        }
    )
    others = [
        take
        for take in takes
        if take is not source and any(one.motion in left and not one.corrected for one in take.segments)
    ]
    stored = StoredSpace.from_bytes(here.blobs.read(record.space))
    collection = collection_of(here, [as_it_was, *others], stored, numbers)
    wanted: dict[tuple[str, int], tuple[str, float]] = {}
    for one in corrected:
        number = numbers[one.motion]  # which no other segment may be of yet
        told = number if number in collection.motion_ids else collection.next_id
        update = correct_segment(collection, source.animation, one.start, is_motion=told)
        for change in update.proposals:
            place = (change.take, change.start)
            if change.sure > wanted.get(place, ("", -1.0))[1]:
                wanted[place] = (one.motion, change.sure)
    after = {
        take.animation: tuple(_relabelled(take, one, wanted) for one in take.segments) for take in [source, *others]
    }
    return after, []


def _relabelled(
    take: TakeRecord, segment: CollectedSegment, wanted: Mapping[tuple[str, int], tuple[str, float]]
) -> CollectedSegment:
    found = wanted.get((take.animation, segment.start))
    if found is None or segment.corrected:
        return segment
    return segment.model_copy(update={"motion": found[0], "confidence": round(max(found[1], 0.0), 4), "distance": None})


def _change(take: TakeRecord, after: Sequence[CollectedSegment]) -> TakeChange:
    frames = changed_frames(take.segments, after)
    return TakeChange(
        animation=take.animation,
        version=take.version,
        segments=tuple(after),
        changed_seconds=frames / take.frame_rate,
    )
