"""The documents that describe collections, made from the records."""

from datetime import UTC, datetime
from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field

from caesura.worker.records.collection_types import (
    CollectedSegment,
    CollectionRecord,
    Exemplar,
    FoundRange,
    MotionRecord,
    MotionSummary,
    ProposalKind,
    ProposalRecord,
    ProposalStatus,
    SearchRecord,
    SearchStatus,
    TakeRecord,
    TakeStatus,
)
from caesura.worker.records.collections import summarise_take


class _Answer(BaseModel):
    model_config = ConfigDict(frozen=True)


class CollectionMotion(_Answer):
    """A motion of a collection, of all its takes together. Its id stays, and is never given to another."""

    id: str
    name: str
    colour: str = Field(description="#rrggbb")
    named: bool = Field(description="whether a person has named it")
    seconds: float = Field(description="of all its segments")
    segments: int
    takes: int = Field(description="how many takes have it")
    exemplar: Exemplar | None = Field(description="the segment that is most like all others")

    @classmethod
    def of(cls, record: MotionRecord) -> Self:
        """The answer for a record."""
        return cls.model_validate(record.model_dump())


class CollectionDocument(_Answer):
    """Takes that are cut into the same motions, but for the takes themselves, which may be a thousand."""

    id: str
    name: str
    status: Literal["working", "ready"] = Field(description="`working` while takes wait to be labelled")
    takes: int
    seconds: float = Field(description="of all takes together, as their headers tell")
    waiting: int = Field(description="takes that are not labelled yet")
    failed: int = Field(description="takes that could not be")
    asked_motions: int | None = Field(description="the number of motions that was asked for; null: found")
    motions: tuple[CollectionMotion, ...]
    version: int = Field(description="counts every change")
    created: datetime = Field(description="when it was made, by RFC 3339")
    updated: datetime = Field(description="when it was changed last")
    links: dict[str, str]

    @classmethod
    def of(cls, record: CollectionRecord) -> Self:
        """The answer for a record."""
        here = f"/v1/collections/{record.id}"
        return cls(
            id=record.id,
            name=record.name,
            status="working" if record.waiting else "ready",
            takes=record.takes,
            seconds=record.seconds,
            waiting=record.waiting,
            failed=record.failed,
            asked_motions=record.asked,
            motions=tuple(map(CollectionMotion.of, record.motions)),
            version=record.version,
            created=_moment(record.created),
            updated=_moment(record.updated),
            links={"self": here, **{name: f"{here}/{name}" for name in ("takes", "proposals", "searches")}},
        )


class CollectionPage(_Answer):
    """Collections, newest first; `next` is the address of the page after this one."""

    collections: tuple[CollectionDocument, ...]
    next: str | None = None


class CollectionSegment(_Answer):
    """Frames [start, end) of a motion, by its id; a person set what is `corrected`."""

    start: int
    end: int
    start_seconds: float
    end_seconds: float
    motion: str
    confidence: float | None = Field(description="how sure its motion is, 0 to 1; null where a person set it")
    corrected: bool

    @classmethod
    def of(cls, record: CollectedSegment) -> Self:
        """The answer for a record."""
        return cls.model_validate(record.model_dump(exclude={"distance"}))


class MotionShare(_Answer):
    """What a take has of one motion; `start` to `end` is its segment that is most like all others."""

    motion: str
    seconds: float
    segments: int
    confidence: float | None = Field(description="how sure its segments are, on average")
    start: int
    end: int
    start_seconds: float
    end_seconds: float

    @classmethod
    def of(cls, motion: str, record: MotionSummary) -> Self:
        """The answer for a record."""
        return cls(motion=motion, **record.model_dump(exclude={"distance"}))


class CollectionTake(_Answer):
    """One animation in a collection, with its segments in the common motions once it is labelled."""

    animation: str
    name: str
    status: TakeStatus
    problem: dict[str, Any] | None
    segmentation: str = Field(description="the segmentation whose analysis it is compared by; the page plays it")
    frames: int | None
    frame_rate: float | None
    motions: tuple[MotionShare, ...]
    segments: tuple[CollectionSegment, ...]
    version: int = Field(description="counts the changes of this take; the ETag")
    added: datetime = Field(description="when it was added, by RFC 3339")
    proposal: str | None = Field(None, description="the proposal that is made of this correction, if it was one")
    links: dict[str, str]

    @classmethod
    def of(cls, collection: str, record: TakeRecord, proposal: str | None = None) -> Self:
        """The answer for a record."""
        here = f"/v1/collections/{collection}/takes/{record.animation}"
        shares = summarise_take(record).motions
        return cls(
            animation=record.animation,
            name=record.name,
            status=record.status,
            problem=record.problem,
            segmentation=record.segmentation,
            frames=record.frames or None,
            frame_rate=record.frame_rate or None,
            motions=tuple(MotionShare.of(motion, share) for motion, share in shares.items()),
            segments=tuple(map(CollectionSegment.of, record.segments)),
            version=record.version,
            added=_moment(record.added),
            proposal=proposal,
            links={
                "self": here,
                "animation": f"/v1/animations/{record.animation}",
                "segmentation": f"/v1/segmentations/{record.segmentation}",
            },
        )


class TakePage(_Answer):
    """Takes of a collection, the last added first; `next` is the address of the page after this one."""

    takes: tuple[CollectionTake, ...]
    next: str | None = None


class ChangeSummary(_Answer):
    """What would become of one take: its segments after it, and how many seconds have another motion than now."""

    animation: str
    changed_seconds: float
    segments: tuple[CollectionSegment, ...]


class ProposalEntry(_Answer):
    """A change that a person accepts or refuses: nothing of it holds before, and all of it after."""

    id: str
    kind: ProposalKind
    status: ProposalStatus
    animation: str | None = Field(description="the take whose correction it is learned from")
    asked_motions: int | None
    problem: dict[str, Any] | None
    takes: int = Field(description="how many takes it would change")
    changed_seconds: float = Field(description="of all takes")
    motions: tuple[CollectionMotion, ...] = Field(description="motions that it would add")
    created: datetime = Field(description="when it was asked for, by RFC 3339")
    links: dict[str, str]

    @classmethod
    def of(cls, collection: str, record: ProposalRecord, **more: Any) -> Self:
        """The answer for a record."""
        here = f"/v1/collections/{collection}"
        return cls(
            id=record.id,
            kind=record.kind,
            status=record.status,
            animation=record.animation or None,
            asked_motions=record.asked,
            problem=record.problem,
            takes=len(record.changes),
            changed_seconds=sum(change.changed_seconds for change in record.changes),
            motions=tuple(map(CollectionMotion.of, record.motions)),
            created=_moment(record.created),
            links={"self": f"{here}/proposals/{record.id}", "collection": here},
            **more,
        )


class ProposalDocument(ProposalEntry):
    """The same with what would become of each take."""

    changes: tuple[ChangeSummary, ...]

    @classmethod
    def whole(cls, collection: str, record: ProposalRecord) -> Self:
        """The answer for a record."""
        changes = tuple(
            ChangeSummary(
                animation=change.animation,
                changed_seconds=change.changed_seconds,
                segments=tuple(map(CollectionSegment.of, change.segments)),
            )
            for change in record.changes
        )
        return cls.of(collection, record, changes=changes)


class ProposalList(_Answer):
    """The proposals that are kept, newest first, but for the takes."""

    proposals: tuple[ProposalEntry, ...]


class SearchDocument(_Answer):
    """A search by example, and the ranges that are like it, nearest first, once it is done."""

    id: str
    status: SearchStatus
    animation: str
    start: int
    end: int
    problem: dict[str, Any] | None
    found: tuple[FoundRange, ...]
    created: datetime = Field(description="when it was asked for, by RFC 3339")
    links: dict[str, str]

    @classmethod
    def of(cls, collection: str, record: SearchRecord) -> Self:
        """The answer for a record."""
        here = f"/v1/collections/{collection}"
        return cls(
            id=record.id,
            status=record.status,
            animation=record.animation,
            start=record.start,
            end=record.end,
            problem=record.problem,
            found=record.found,
            created=_moment(record.created),
            links={"self": f"{here}/searches/{record.id}", "collection": here},
        )


def _moment(seconds: float) -> datetime:
    return datetime.fromtimestamp(seconds, UTC)
