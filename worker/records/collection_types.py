"""The records of collections: takes that are cut into the same motions. Frames are half-open, [start, end)."""

from typing import Any, Literal

from caesura.worker.records.record_types import Record

TakeStatus = Literal["waiting", "labelled", "failed"]
ProposalKind = Literal["recut", "correction"]
ProposalStatus = Literal["working", "open", "accepted", "refused", "empty", "failed"]
SearchStatus = Literal["working", "done", "failed"]


class Exemplar(Record):
    """The segment of a motion that is most like all others, and of which take it is."""

    animation: str
    start: int
    end: int
    start_seconds: float
    end_seconds: float


class MotionRecord(Record):
    """One motion of a collection. Its id is never given to another; `named` where a person has named it.

    `seconds`, `segments`, `takes` and `exemplar` are of all takes together.
    """

    id: str
    name: str
    colour: str
    named: bool = False
    seconds: float = 0.0
    segments: int = 0
    takes: int = 0
    exemplar: Exemplar | None = None


class CollectedSegment(Record):
    """A segment of one take. `distance` is how far it is from the others of its motion. A person set what is
    `corrected`, and the program leaves it; `left` is the motion that it was of before."""

    start: int
    end: int
    start_seconds: float
    end_seconds: float
    motion: str
    confidence: float | None = None
    distance: float | None = None
    corrected: bool = False
    left: str = ""


class TakeNumbers(Record):
    """The blobs that a take is compared by: its poses with its own cut, and, in the space of the collection that the
    blob `space` holds, the signatures of its segments and what is searched."""

    poses: str
    space: str = ""
    signatures: str | None = None
    searched: str | None = None

    def blobs(self) -> list[str]:
        """Every blob that is of this take alone."""
        return [key for key in (self.poses, self.signatures, self.searched) if key is not None]


class TakeRecord(Record):
    """One animation in a collection. `numbers` is what it is compared by; `version` counts its changes.
    `seconds` is its duration as its header tells, the file's longest take; `begin` is the time of its first frame.

    It waits for `segmentation`, whose analysis the numbers are made of.
    """

    animation: str
    segmentation: str
    name: str
    added: float
    seconds: float = 0.0
    status: TakeStatus = "waiting"
    problem: dict[str, Any] | None = None
    frames: int = 0
    frame_rate: float = 0.0
    begin: float = 0.0
    version: int = 0
    numbers: TakeNumbers | None = None
    segments: tuple[CollectedSegment, ...] = ()


class MotionSummary(Record):
    """What one take has of one motion: with its segment that is most like the others."""

    seconds: float
    segments: int
    confidence: float | None = None
    distance: float | None = None
    start: int
    end: int
    start_seconds: float
    end_seconds: float


class TakeEntry(Record):
    """One take in short: its state, and what it has of each motion by its id."""

    status: TakeStatus
    added: float
    seconds: float = 0.0
    motions: dict[str, MotionSummary]


class CollectionRecord(Record):
    """Takes that are cut into the same motions; the takes lie beside it. `version` counts all changes.

    `asked` is the number of motions that the takes are cut into at first; None: found. `space` is the blob of the pose
    space that takes are compared in, learned from `learned` of them.
    """

    id: str
    owner: str
    name: str
    created: float
    updated: float
    version: int = 0
    asked: int | None = None
    space: str = ""
    learned: int = 0
    motions: tuple[MotionRecord, ...] = ()
    takes: int = 0
    seconds: float = 0.0
    waiting: int = 0
    failed: int = 0


class TakeChange(Record):
    """What a proposal would make of one take, as it was in this version."""

    animation: str
    version: int
    segments: tuple[CollectedSegment, ...]
    changed_seconds: float


class ProposalRecord(Record):
    """A change of a collection that a person accepts or refuses; nothing of it holds before.

    `motions` are new ones that it would bring. `animation` is the take whose correction it is learned from.
    """

    id: str
    kind: ProposalKind
    created: float
    token: str = ""
    status: ProposalStatus = "working"
    asked: int | None = None
    animation: str = ""
    problem: dict[str, Any] | None = None
    motions: tuple[MotionRecord, ...] = ()
    changes: tuple[TakeChange, ...] = ()


class FoundRange(Record):
    """A range of a take that is like the example: the smaller the distance, the more."""

    animation: str
    start: int
    end: int
    start_seconds: float
    end_seconds: float
    distance: float


class SearchRecord(Record):
    """A search by example, frames [start, end) of an animation, and what it found, nearest first."""

    id: str
    created: float
    animation: str
    segmentation: str
    start: int
    end: int
    limit: int
    token: str = ""
    status: SearchStatus = "working"
    problem: dict[str, Any] | None = None
    found: tuple[FoundRange, ...] = ()
