"""Segments of a take, the markers that say where they begin, and the revision that they are."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any


@dataclass(frozen=True)
class Segment:
    """Frames [start, end) of the take, counted from 0, of the motion called `name`."""

    start: int
    end: int
    name: str
    loop: bool = False
    discard: bool = False


@dataclass(frozen=True)
class Mark:
    """A marker: its name and its frame on the time line."""

    name: str
    frame: int


def segments_of_document(document: Mapping[str, Any]) -> list[Segment]:
    """The segments of a segmentation document."""
    return [
        Segment(found["start"], found["end"], found["name"], found.get("loop", False), found.get("discard", False))
        for found in document["segments"]
    ]


def marks_of_segments(segments: Iterable[Segment], first: int) -> list[Mark]:
    """A marker at the beginning of each segment, in a take whose frame 0 is frame `first` of the time line."""
    return [Mark(segment.name, first + segment.start) for segment in segments]


def segments_of_marks(
    marks: Iterable[Mark], first: int, frames: int, loops: Iterable[str] = (), discards: Iterable[str] = ()
) -> list[Segment]:
    """What the markers say: a segment from each to the next, of the motion that it is called by.

    A marker outside the take is no cut; of several on one frame the last counts. The first segment begins with the
    take wherever its marker stands; without markers the take is one segment.
    """
    looping, discarded = set(loops), set(discards)
    placed = {mark.frame - first: mark.name.strip() for mark in sorted(marks, key=lambda mark: mark.frame)}
    inside = [(frame, name) for frame, name in placed.items() if 0 <= frame < frames] or [(0, "A")]
    starts = [0, *(frame for frame, _ in inside[1:])]
    return [
        Segment(start, end, name or "A", name in looping, name in discarded)
        for start, end, (_, name) in zip(starts, [*starts[1:], frames], inside, strict=True)
    ]


def own_marks(marks: Iterable[Mark], others: Iterable[Mark], motions: Iterable[str]) -> list[Mark]:
    """The markers without those that were there before the result, which are known by name.

    One that is called as a motion is known by its frame too.
    """
    called = set(motions)
    names = {mark.name for mark in others} - called
    places = {(mark.name, mark.frame) for mark in others}
    return [mark for mark in marks if mark.name not in names and (mark.name, mark.frame) not in places]


def revision_of_segments(segments: Sequence[Segment]) -> list[dict[str, Any]]:
    """The segments as the service takes them: segments of one name are of one motion."""
    motions: dict[str, int] = {}
    return [
        {
            "start": segment.start,
            "end": segment.end,
            "motion": motions.setdefault(segment.name, len(motions)),
            "name": segment.name,
            "loop": segment.loop,
            "discard": segment.discard,
        }
        for segment in segments
    ]


def clip_names(segments: Sequence[Segment]) -> list[str]:
    """What the clip of each segment is called: motion and number, such as `A_01`."""
    seen: Counter[str] = Counter()
    names = []
    for segment in segments:
        seen[segment.name] += 1
        names.append(f"{segment.name}_{seen[segment.name]:02}")
    return names


def motion_names(segments: Iterable[Segment]) -> list[str]:
    """The motions, by first appearance."""
    return list(dict.fromkeys(segment.name for segment in segments))


def rename_motion(segments: Iterable[Segment], old: str, new: str) -> list[Segment]:
    """The same with a motion called otherwise."""
    return [replace(segment, name=new) if segment.name == old else segment for segment in segments]
