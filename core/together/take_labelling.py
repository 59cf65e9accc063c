"""A further take, labelled by the motions that a collection knows; what is none of them is a new one."""

from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import ParameterError
from caesura.core.together.measured_take import MeasuredTake
from caesura.core.together.motion_collection import (
    CollectedTake,
    CollectionUpdate,
    MotionCollection,
    SegmentChange,
)
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.take_segments import collect_segments, sign_take

APART = 0.6
"""What it costs that two motions of one take are one known motion."""
NEW = 1.2
"""A motion is new where it is farther than this from all known ones, in distances that are alike within a motion."""
MOST_EXEMPLARS = 12
"""Segments of each motion that a new one is compared with."""


def label_take(collection: MotionCollection, take: MeasuredTake) -> CollectionUpdate:
    """The collection with one take more. Nothing that is there changes; new motions get new ids.

    The work is that of the take times the number of motions, however many segments they have. Raises `InvalidModel`
    (`not-comparable`) for another body, and `ParameterError` (`same-name`) where the take is there already.
    """
    if any(one.name == take.name for one in collection.takes):
        raise ParameterError("same-name", f"The collection has a take {take.name!r} already.")
    signatures = sign_take(collection.space, take)
    own = np.unique(take.motions)
    costs = np.stack([_motion_costs(collection, signatures[np.flatnonzero(take.motions == one)]) for one in own])
    chosen, sure = choose_motions(costs, NEW * collection.alike)
    ids = np.array([*collection.motion_ids, *range(collection.next_id, collection.next_id + len(own))])
    new = sorted({int(ids[i]) for i in chosen if i >= len(collection.motion_ids)})
    numbered = {one: collection.next_id + i for i, one in enumerate(new)}
    motion = {int(one): numbered.get(int(ids[i]), int(ids[i])) for one, i in zip(own, chosen, strict=True)}
    certain = dict(zip(own.tolist(), sure, strict=True))
    segments = tuple(
        replace(segment, motion=motion[segment.own_motion], sure=certain[segment.own_motion])
        for segment in collect_segments(take)
    )
    updated = replace(
        collection,
        takes=(*collection.takes, CollectedTake(take.name, take.poses.frames, take.poses.frame_rate)),
        segments=(*collection.segments, *segments),
        signatures=MotionSignatures.joined([collection.signatures, signatures]),
        next_id=collection.next_id + len(new),
    )
    changes = tuple(SegmentChange(one.take, one.start, one.end, None, one.motion, one.sure) for one in segments)
    return CollectionUpdate(updated, changes, new_motions=tuple(numbered.values()))


def remove_take(collection: MotionCollection, name: str) -> CollectionUpdate:
    """The collection without a take; motions that were only there are gone, and their ids with them."""
    collection.of_take(name)
    kept = np.array([i for i, one in enumerate(collection.segments) if one.take != name], np.int64)
    segments = tuple(collection.segments[i] for i in kept)
    left = {segment.motion for segment in segments}
    gone = tuple(motion for motion in collection.motion_ids if motion not in left)
    updated = replace(
        collection,
        takes=tuple(take for take in collection.takes if take.name != name),
        segments=segments,
        signatures=collection.signatures[kept],
        names=tuple((motion, said) for motion, said in collection.names if motion in left),
    )
    return CollectionUpdate(updated, gone_motions=gone)


def _motion_costs(collection: MotionCollection, signatures: MotionSignatures) -> Float[np.ndarray, "motions"]:
    """How unlike segments are, on average, to each motion of the collection."""
    costs = []
    for motion in collection.motion_ids:
        members = collection.members(motion)
        asked = members[:: max(len(members) // MOST_EXEMPLARS, 1)][:MOST_EXEMPLARS]
        apart = signatures.distances(collection.signatures[asked], collection.spreads, collection.space.signs)
        costs.append(float(np.sort(apart, axis=1)[:, : max(len(asked) // 2, 1)].mean()))
    return np.array(costs)


def choose_motions(costs: Float[np.ndarray, "own motions"], new: float) -> tuple[Int[np.ndarray, "own"], list[float]]:
    """For each of a take's own motions which known one it is, or, after those, a new one; and how sure that is, 0 to 1.

    A new motion costs `new`. Two own motions may be one known motion, at the cost of what sets them apart.
    """
    own, known = costs.shape
    chosen = np.full(own, -1)
    sure = [0.0] * own
    best = costs.min(axis=1) if known else np.full(own, np.inf)
    for one in np.argsort(best, kind="stable").tolist():
        taken = np.bincount(chosen[chosen >= 0], minlength=known + own)[:known] > 0
        asked = np.append(costs[one] + APART * taken, new)
        order = np.argsort(asked, kind="stable")
        chosen[one] = order[0] if order[0] < known else known + one
        first = float(asked[order[0]])
        second = float(asked[order[1]]) if known else 2 * new
        sure[one] = float(np.clip((second - first) / (second or 1.0), 0.0, 1.0))
    return chosen, sure
