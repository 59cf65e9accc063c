"""A collection: the motions of several takes, and every segment with the motion that it is of. Frozen.

Motions have ids that stay: a motion that is gone leaves its number unused. Names and what a person said of a segment
are changed by people only.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from jaxtyping import Float, Int

from caesura.core.errors import ParameterError
from caesura.core.segmentation_document import motion_name
from caesura.core.together.motion_signature import MotionSignatures
from caesura.core.together.pose_space import PoseSpace


@dataclass(frozen=True)
class CollectedTake:
    """A take in a collection: its name, frames and frame rate."""

    name: str
    frames: int
    frame_rate: float


@dataclass(frozen=True)
class CollectedSegment:
    """Frames [start, end) of a take, and the id of the common motion that they are of.

    `own_motion`: the number of the motion in the take's own result. `sure`, 0 to 1: how much nearer this motion is than
    the next. `fixed`: a person said so. `refused`: motions that it is not, as a person said. `repetitions`: how often
    the motion is performed in it.
    """

    take: str
    start: int
    end: int
    seconds: float
    motion: int
    own_motion: int
    repetitions: int = 1
    sure: float = 1.0
    fixed: bool = False
    refused: tuple[int, ...] = ()


@dataclass(frozen=True)
class CommonMotion:
    """A motion of a collection. `id` stays; `name` is a person's, or None, and then letters by the id.

    `exemplar`: the number of the segment most like all others of the motion.
    """

    id: int
    name: str | None
    seconds: float
    segments: int
    takes: int
    exemplar: int

    @property
    def shown_name(self) -> str:
        """Its name, or letters."""
        return self.name or motion_name(self.id)


@dataclass(frozen=True)
class SegmentChange:
    """Segment `start` to `end` of a take goes from motion `before` to motion `after`; None is a motion that is new, or
    a segment that is."""

    take: str
    start: int
    end: int
    before: int | None
    after: int | None
    sure: float = 1.0


@dataclass(frozen=True)
class CollectionUpdate:
    """A collection as it would be, what changes for it, and what is proposed beside: none of it is done yet.

    `new_motions`: the ids of motions that came in; `gone_motions`: of those whose last segment left.
    """

    collection: "MotionCollection"
    changes: tuple[SegmentChange, ...] = ()
    proposals: tuple[SegmentChange, ...] = ()
    new_motions: tuple[int, ...] = ()
    gone_motions: tuple[int, ...] = ()


@dataclass(frozen=True)
class MotionCollection:
    """The motions of several takes.

    `signatures` has a row for every segment; `spreads` (3,) and `alike` say when two are one motion: `alike` is the
    largest distance within a motion. `next_id`: the number of the next motion that comes in.
    """

    space: PoseSpace
    takes: tuple[CollectedTake, ...]
    segments: tuple[CollectedSegment, ...]
    signatures: MotionSignatures
    names: tuple[tuple[int, str], ...]
    spreads: Float[np.ndarray, "3"]
    alike: float
    next_id: int

    @property
    def motion_ids(self) -> tuple[int, ...]:
        """The ids of all motions that have a segment, in order."""
        return tuple(sorted({segment.motion for segment in self.segments}))

    @property
    def motions(self) -> tuple[CommonMotion, ...]:
        """Every motion, in the order of ids. O(segments of the largest motion), squared."""
        names = dict(self.names)
        return tuple(self._motion(motion, names.get(motion)) for motion in self.motion_ids)

    @property
    def shown_names(self) -> dict[int, str]:
        """The name of every motion by its id: a person's, or letters."""
        return {motion: motion_name(motion) for motion in self.motion_ids} | dict(self.names)

    def members(self, motion: int) -> Int[np.ndarray, "members"]:
        """The numbers of the segments of a motion."""
        return np.array([i for i, one in enumerate(self.segments) if one.motion == motion], np.int64)

    def of_take(self, take: str) -> tuple[CollectedSegment, ...]:
        """The segments of one take, in order; raises `ParameterError` (`unknown-take`)."""
        self._check_take(take)
        return tuple(segment for segment in self.segments if segment.take == take)

    def labels(self, take: str) -> Int[np.ndarray, "frames"]:
        """The id of the motion of every frame of a take."""
        segments = self.of_take(take)
        return np.repeat([one.motion for one in segments], [one.end - one.start for one in segments])

    def index_of(self, take: str, start: int) -> int:
        """The number of the segment of a take that begins at a frame; raises `ParameterError` where there is none."""
        self._check_take(take)
        for i, segment in enumerate(self.segments):
            if (segment.take, segment.start) == (take, start):
                return i
        raise ParameterError("unknown-segment", f"No segment of {take!r} begins at frame {start}.", frame=start)

    def with_name(self, motion: int, name: str | None) -> "MotionCollection":
        """The same with a motion renamed; None takes the name away. Raises `ParameterError` (`unknown-motion`)."""
        self.check_motion(motion)
        names = {**dict(self.names), motion: name}
        return replace(self, names=tuple((number, said) for number, said in sorted(names.items()) if said))

    def check_motion(self, motion: int) -> None:
        """Raise `ParameterError` (`unknown-motion`) where there is no such motion."""
        if motion not in self.motion_ids:
            known = ", ".join(map(str, self.motion_ids[:20]))
            raise ParameterError("unknown-motion", f"There is no motion {motion}. The motions are {known}.")

    def distances(self, some: Int[np.ndarray, "n"], others: Int[np.ndarray, "m"]) -> Float[np.ndarray, "n m"]:
        """How unlike segments are, by number; `alike` is the limit within a motion."""
        return self.signatures[some].distances(self.signatures[others], self.spreads, self.space.signs)

    def document(self) -> dict[str, Any]:
        """The collection as plain values, for JSON."""
        by_take: dict[str, list[dict[str, Any]]] = {}
        names = self.shown_names
        for segment in self.segments:
            by_take.setdefault(segment.take, []).append(_described(segment, names))
        return {
            "motions": [
                {
                    "id": motion.id,
                    "name": motion.shown_name,
                    "named": motion.name is not None,
                    "seconds": round(motion.seconds, 3),
                    "segments": motion.segments,
                    "takes": motion.takes,
                    "exemplar": _place(self.segments[motion.exemplar]),
                }
                for motion in self.motions
            ],
            "takes": [
                {
                    "name": take.name,
                    "frames": take.frames,
                    "frame_rate": take.frame_rate,
                    "segments": by_take.get(take.name, []),
                }
                for take in self.takes
            ],
        }

    def _motion(self, motion: int, name: str | None) -> CommonMotion:
        members = self.members(motion)
        seconds = float(sum(self.segments[i].seconds for i in members))
        takes = len({self.segments[i].take for i in members})
        return CommonMotion(motion, name, seconds, len(members), takes, self.exemplar(members))

    def exemplar(self, members: Int[np.ndarray, "members"]) -> int:
        """The segment most like all others; of more than `MOST_COMPARED` only so many are asked."""
        step = max(len(members) // MOST_COMPARED, 1)
        asked = members[::step][:MOST_COMPARED]
        return int(members[int(np.argmin(self.distances(members, asked).sum(axis=1)))])

    def _check_take(self, take: str) -> None:
        if all(one.name != take for one in self.takes):
            raise ParameterError("unknown-take", f"There is no take {take!r} in this collection.")


MOST_COMPARED = 200
"""Segments of a motion that a segment is compared with."""


def _place(segment: CollectedSegment) -> dict[str, str | int]:
    return {"take": segment.take, "start": segment.start, "end": segment.end}


def _described(segment: CollectedSegment, names: Mapping[int, str]) -> dict[str, Any]:
    return {
        "start": segment.start,
        "end": segment.end,
        "seconds": round(segment.seconds, 3),
        "motion": segment.motion,
        "name": names[segment.motion],
        "repetitions": segment.repetitions,
        "sure": round(segment.sure, 4),
        "fixed": segment.fixed,
        "not": list(segment.refused),
    }


Told = int | Literal["auto"]
"""How many motions there are, or that nobody says it."""
