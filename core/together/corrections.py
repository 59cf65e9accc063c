"""Corrections: what a person says of one segment, and what that proposes for others that are like it."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from caesura.core.together.motion_collection import CollectedSegment, CollectionUpdate, MotionCollection, SegmentChange

MOST_PROPOSED = 100


def correct_segment(
    collection: MotionCollection, take: str, start: int, *, is_motion: int | None = None, is_not: int | None = None
) -> CollectionUpdate:
    """What a person says of the segment of a take that begins at frame `start`: which motion it is, or is not.

    `is_motion`: the id of a motion, or `collection.next_id` for a new one. `is_not` alone: it goes to the motion that
    is the next like it, or to a new one. The segment is fixed from then on. Proposed, and not done, is the same change
    for other segments of the motion that it left which are nearer to it than to the motion's exemplar, and that no
    person has fixed.

    Raises `ParameterError`: `unknown-take`, `unknown-segment`, `unknown-motion`.
    """
    at = collection.index_of(take, start)
    segment = collection.segments[at]
    refused = segment.refused
    if is_not is not None:
        collection.check_motion(is_not)
        refused = tuple(sorted({*refused, is_not}))
    if is_motion is None:
        is_motion = segment.motion if segment.motion not in refused else _next_like(collection, at, refused)
    elif is_motion != collection.next_id:
        collection.check_motion(is_motion)
    changed = replace(
        segment, motion=is_motion, sure=1.0, fixed=True, refused=tuple(one for one in refused if one != is_motion)
    )
    updated = _with_segment(collection, at, changed)
    change = SegmentChange(take, segment.start, segment.end, segment.motion, is_motion)
    proposals = _proposals(collection, at, is_motion) if is_motion != segment.motion else ()
    return _update(collection, updated, (change,), proposals)


def apply_changes(collection: MotionCollection, changes: Iterable[SegmentChange]) -> CollectionUpdate:
    """The collection with changes that a person accepted; the segments are fixed from then on.

    Raises `ParameterError` where a segment or a motion is not there.
    """
    made, updated = [], collection
    for change in changes:
        at = updated.index_of(change.take, change.start)
        segment = updated.segments[at]
        motion = updated.next_id if change.after is None else change.after
        if motion != updated.next_id:
            updated.check_motion(motion)
        updated = _with_segment(updated, at, replace(segment, motion=motion, sure=1.0, fixed=True))
        made.append(replace(change, before=segment.motion, after=motion))
    return _update(collection, updated, tuple(made), ())


def _with_segment(collection: MotionCollection, at: int, segment: CollectedSegment) -> MotionCollection:
    segments = [*collection.segments]
    segments[at] = segment
    motion = segments[at].motion
    return replace(collection, segments=tuple(segments), next_id=max(collection.next_id, motion + 1))


def _next_like(collection: MotionCollection, at: int, refused: tuple[int, ...]) -> int:
    """The motion that is nearest of those that a segment may be, or a new one."""
    distances = {}
    for motion in collection.motion_ids:
        members = collection.members(motion)
        members = members[members != at]
        if motion not in refused and len(members):
            distances[motion] = float(np.median(collection.distances(np.array([at]), members)))
    nearest = min(distances, key=lambda motion: distances[motion], default=collection.next_id)
    return nearest if distances.get(nearest, np.inf) <= collection.alike else collection.next_id


def _proposals(collection: MotionCollection, at: int, motion: int) -> tuple[SegmentChange, ...]:
    """The same change for others of the motion left that are nearer to this segment than to the motion's exemplar."""
    left = collection.segments[at].motion
    others = [i for i in collection.members(left).tolist() if i != at and not collection.segments[i].fixed]
    rest = np.array(others, np.int64)
    if len(rest) == 0:
        return ()
    typical = collection.exemplar(rest)
    apart = collection.distances(rest, np.array([at, typical]))
    nearer = [
        (float(far / ((far + near) or 1.0)), i)
        for i, (near, far) in zip(others, apart.tolist(), strict=True)
        if near < far
    ]
    found = []
    for sure, i in sorted(nearer, reverse=True)[:MOST_PROPOSED]:
        one = collection.segments[i]
        if motion not in one.refused:
            found.append(SegmentChange(one.take, one.start, one.end, left, motion, round(2 * sure - 1, 4)))
    return tuple(found)


def _update(
    before: MotionCollection,
    after: MotionCollection,
    changes: tuple[SegmentChange, ...],
    proposals: tuple[SegmentChange, ...],
) -> CollectionUpdate:
    old, new = set(before.motion_ids), set(after.motion_ids)
    return CollectionUpdate(after, changes, proposals, tuple(sorted(new - old)), tuple(sorted(old - new)))
