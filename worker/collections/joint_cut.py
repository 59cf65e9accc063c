"""All takes of a collection cut together: one set of motions over all of them."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from caesura.core.errors import InvalidModel
from caesura.core.progress import Progress, ignore_progress
from caesura.core.together.compared_body import ComparedBody
from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.motion_collection import MOST_COMPARED, MotionCollection
from caesura.core.together.segment_together import segment_together
from caesura.worker.collections.corrected_takes import segment_at
from caesura.worker.collections.stored_space import StoredSpace
from caesura.worker.records.collection_types import CollectedSegment, TakeRecord


@dataclass(frozen=True)
class JointCut:
    """The motions found, and what takes cannot be compared, by animation, with the reason."""

    collection: MotionCollection
    refused: Mapping[str, dict[str, object]]

    @property
    def space(self) -> StoredSpace:
        """The space that the takes were compared in."""
        return StoredSpace(self.collection.space, self.collection.spreads)


def cut_together(takes: Sequence[MeasuredTake], asked: int | None, progress: Progress = ignore_progress) -> JointCut:
    """One set of motions over all takes of the body that most of them have; the others are refused, each by name.

    Raises `ParameterError` where so many motions are not possible.
    """
    bodies = Counter((take.poses.kind, take.poses.topology) for take in takes)
    most = bodies.most_common(1)[0][0]
    fitting = [take for take in takes if (take.poses.kind, take.poses.topology) == most]
    refused: dict[str, dict[str, object]] = {}
    for take in takes:
        if take not in fitting:
            refused[take.name] = _difference(fitting[0], take)
    while True:
        try:
            return JointCut(segment_together(fitting, asked or "auto", progress=progress), refused)
        except InvalidModel as differs:
            odd = str(differs.problem().get("take", ""))
            if differs.code != "not-comparable" or all(take.name != odd for take in fitting) or len(fitting) < 2:
                raise
            refused[odd] = differs.problem()
            fitting = [take for take in fitting if take.name != odd]


def collected_segments(
    collection: MotionCollection, takes: Iterable[TakeRecord], names: Mapping[int, str]
) -> dict[str, tuple[CollectedSegment, ...]]:
    """The segments of takes as their records hold them, in motions called by `names`: by animation."""
    records = {take.animation: take for take in takes}
    rows = [row for row, one in enumerate(collection.segments) if one.take in records]
    found: dict[str, list[CollectedSegment]] = {name: [] for name in records}
    for row, far in zip(rows, _mean_distances(collection, rows), strict=True):
        one = collection.segments[row]
        segment = segment_at(records[one.take], (one.start, one.end, names[one.motion]))
        rounded = {"confidence": round(one.sure, 4), "distance": round(far, 5)}
        found[one.take].append(segment.model_copy(update=rounded))
    return {name: tuple(segments) for name, segments in found.items()}


def _mean_distances(collection: MotionCollection, rows: Sequence[int]) -> list[float]:
    """How far segments are from the others of their motion, on average."""
    motions = np.array([collection.segments[row].motion for row in rows], np.int64)
    far = np.zeros(len(rows))
    for motion in np.unique(motions).tolist():
        members = collection.members(motion)
        asked = members[:: max(len(members) // MOST_COMPARED, 1)][:MOST_COMPARED]
        ours = np.flatnonzero(motions == motion)
        far[ours] = collection.distances(np.array(rows)[ours], asked).mean(axis=1)
    return far.tolist()


def _difference(one: MeasuredTake, other: MeasuredTake) -> dict[str, object]:
    try:
        ComparedBody.of([(one.name, one.poses), (other.name, other.poses)])
    except InvalidModel as differs:
        return differs.problem()
    raise AssertionError("they are of one body")
