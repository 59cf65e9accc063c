"""Segments that people set: they tile a take, and what the program finds anew is laid around them. Light: no NumPy."""

from collections import Counter
from collections.abc import Sequence

from caesura.core.errors import ParameterError
from caesura.worker.records.collection_types import CollectedSegment, TakeRecord

Range = tuple[int, int, str]
"""First frame, end, and the id of a motion."""


def correct_take(take: TakeRecord, wanted: Sequence[Range]) -> TakeRecord:
    """The take with these segments; those that are as they were stay what they are, the others are corrected.

    Raises `ParameterError` ("invalid-segments") where they do not tile its frames.
    """
    at = 0
    for number, (start, end, _) in enumerate(wanted):
        if start != at or end <= start or end > take.frames:
            detail = f"Segment {number + 1} is frames {start} to {end}; it must begin at {at} and end by {take.frames}."
            raise ParameterError("invalid-segments", detail, pointer=f"/segments/{number}")
        at = end
    if at != take.frames:
        detail = f"The segments end at frame {at}, and the take has {take.frames}."
        raise ParameterError("invalid-segments", detail, pointer="/segments")
    before = {(one.start, one.end, one.motion): one for one in take.segments}
    segments = tuple(before.get(one) or _corrected(take, one) for one in wanted)
    return with_segments(take, segments)


def with_segments(take: TakeRecord, segments: Sequence[CollectedSegment]) -> TakeRecord:
    """The take in its next version, with these segments; signatures of ranges that are no more are forgotten."""
    ranges = [[(one.start, one.end) for one in kept] for kept in (take.segments, segments)]
    numbers = take.numbers
    if numbers is not None and ranges[0] != ranges[1]:
        numbers = numbers.model_copy(update={"signatures": None})
    return take.model_copy(update={"segments": tuple(segments), "version": take.version + 1, "numbers": numbers})


def lay_around_corrections(take: TakeRecord, found: Sequence[CollectedSegment]) -> tuple[CollectedSegment, ...]:
    """What the program finds anew, except where a person has corrected the take: that stays as it is."""
    corrected = [one for one in take.segments if one.corrected]
    laid = list(corrected)
    for segment in found:
        at = segment.start
        for fixed in [one for one in corrected if one.start < segment.end and segment.start < one.end]:
            if at < fixed.start:
                laid.append(_part(take, segment, at, fixed.start))
            at = max(at, fixed.end)
        if at < segment.end:
            laid.append(_part(take, segment, at, segment.end))
    return tuple(sorted(laid, key=lambda one: one.start))


def changed_frames(before: Sequence[CollectedSegment], after: Sequence[CollectedSegment]) -> int:
    """How many frames have another motion."""
    cuts = sorted({one.end for one in (*before, *after)})
    labels = [_labels(segments, cuts) for segments in (before, after)]
    return sum(end - start for start, end, old, new in zip([0, *cuts], cuts, *labels, strict=False) if old != new)


def segment_at(take: TakeRecord, wanted: Range) -> CollectedSegment:
    """The segment of these frames, with its times in the take."""
    start, end, motion = wanted
    return CollectedSegment(
        start=start,
        end=end,
        start_seconds=take.begin + start / take.frame_rate,
        end_seconds=take.begin + min(end, take.frames - 1) / take.frame_rate,
        motion=motion,
    )


def _corrected(take: TakeRecord, wanted: Range) -> CollectedSegment:
    """A segment that a person set, with the motion that most of it was of before."""
    start, end, _ = wanted
    shared = Counter[str]()
    for one in take.segments:
        shared[one.motion] += max(min(end, one.end) - max(start, one.start), 0)
    left = shared.most_common(1)[0][0] if shared else ""
    return segment_at(take, wanted).model_copy(update={"corrected": True, "left": left})


def _part(take: TakeRecord, segment: CollectedSegment, start: int, end: int) -> CollectedSegment:
    if (start, end) == (segment.start, segment.end):
        return segment
    kept = {"confidence": segment.confidence, "distance": segment.distance}
    return segment_at(take, (start, end, segment.motion)).model_copy(update=kept)


def _labels(segments: Sequence[CollectedSegment], cuts: Sequence[int]) -> list[str]:
    """The motion before each cut."""
    found, place = [], 0
    for cut in cuts:
        while place < len(segments) - 1 and segments[place].end < cut:
            place += 1
        found.append(segments[place].motion if segments else "")
    return found
