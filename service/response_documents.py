"""The documents that the API answers with: their fields, made from the records."""

from datetime import UTC, datetime
from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field

from caesura.core.segmentation_document import Segment
from caesura.worker.queue.overall_progress import overall_fraction, remaining_seconds
from caesura.worker.records.record_types import AnimationRecord, RevisionRecord, SegmentationRecord, Status, TakeSummary


class _Answer(BaseModel):
    model_config = ConfigDict(frozen=True)


class AnimationSummary(_Answer):
    """An uploaded file, as its header describes it; null is what a header does not tell."""

    id: str
    name: str
    format: str
    bytes: int
    take_count: int
    duration_seconds: float | None = Field(description="of the longest take")
    vertices: int | None
    triangles: int | None
    created: datetime = Field(description="when it was made, by RFC 3339")
    edited: str | None = Field(None, description="the segmentation that a person edited last")
    links: dict[str, str]

    @classmethod
    def of(cls, record: AnimationRecord, **more: Any) -> Self:
        """The answer for a record."""
        here = f"/v1/animations/{record.id}"
        return cls(
            id=record.id,
            name=record.name,
            format=record.format,
            bytes=sum(part.bytes for part in record.parts),
            take_count=record.take_count,
            duration_seconds=record.seconds,
            vertices=record.vertices,
            triangles=record.triangles,
            created=_moment(record.created),
            links={"self": here, "file": f"{here}/file", "segmentations": f"/v1/segmentations?animation={record.id}"},
            **more,
        )


class AnimationDocument(AnimationSummary):
    """The same with its takes, of which there may be thousands."""

    takes: tuple[TakeSummary, ...]


class AnimationPage(_Answer):
    """Animations without their takes, newest first; `next` is the address of the page after this one."""

    animations: tuple[AnimationSummary, ...]
    next: str | None = None


class StageProgress(_Answer):
    """What is being done, how much of that and how much of all is done, 0 to 1, and how long the rest may take."""

    stage: str
    fraction: float = Field(description="of this stage")
    overall: float = Field(0.0, description="of all stages")
    remaining_seconds: float | None = Field(None, description="an estimate; null where too little is done for one")

    @classmethod
    def of(cls, record: SegmentationRecord) -> Self:
        """The progress of a record."""
        return cls(
            stage=record.stage,
            fraction=record.fraction,
            overall=round(overall_fraction(record), 4),
            remaining_seconds=remaining_seconds(record),
        )


class StatusDocument(_Answer):
    """How far a segmentation is; `motions`, `frames` and `segments` once it is done, `problem` once it has failed."""

    id: str
    animation: str
    name: str
    status: Status
    position: int | None = Field(description="how many jobs come before it, while it is queued")
    progress: StageProgress
    problem: dict[str, Any] | None
    motions: int | None
    frames: int | None
    segments: tuple[Segment, ...] | None = Field(description="null in a list")
    revision: int = Field(0, description="the newest revision; 0 while nobody has edited the result")
    parameters: dict[str, Any] = Field(description="what was asked for, with the defaults filled in")
    created: datetime = Field(description="when it was made, by RFC 3339")
    started: datetime | None = Field(None, description="when a worker began; null while it is queued")
    finished: datetime | None = Field(None, description="when it was done, failed or was cancelled; null before")
    links: dict[str, str]

    @classmethod
    def of(cls, record: SegmentationRecord, position: int | None = None) -> Self:
        """The answer for a record."""
        done = record.status == "done"
        return cls(
            id=record.id,
            animation=record.animation,
            name=record.name,
            status=record.status,
            position=position,
            progress=StageProgress.of(record),
            problem=record.problem,
            motions=record.motions if done else None,
            frames=record.frames if done else None,
            segments=record.segments if done else None,
            revision=record.revision,
            parameters=record.parameters,
            created=_moment(record.created),
            started=_moment(record.started) if record.started else None,
            finished=_moment(record.finished) if record.finished else None,
            links=_links(record.id),
        )


class SegmentationPage(_Answer):
    """Segmentations without their segments, newest first; `next` is the address of the page after this one."""

    segmentations: tuple[StatusDocument, ...]
    next: str | None = None


def _moment(seconds: float) -> datetime:
    """A time in seconds since 1970, in UTC."""
    return datetime.fromtimestamp(seconds, UTC)


def _links(identifier: str) -> dict[str, str]:
    here = f"/v1/segmentations/{identifier}"
    named = {name: f"{here}/{name}" for name in ("events", "result", "revisions", "clips", "keyframes", "viewer")}
    return {"self": here, **named, "plot": f"{here}/plot.svg", "page": f"/view/{identifier}"}


class RevisionEntry(_Answer):
    """One revision of a result, but for its segments; revision 0 is the result as computed."""

    revision: int
    created: datetime = Field(description="when it was made, by RFC 3339")
    note: str
    links: dict[str, str]

    @classmethod
    def of(cls, identifier: str, record: RevisionRecord, **more: Any) -> Self:
        """The answer for a record."""
        here, query = f"/v1/segmentations/{identifier}", f"?revision={record.number}"
        links = {name: f"{here}/{name}{query}" for name in ("result", "clips", "keyframes")}
        links = {"self": f"{here}/revisions/{record.number}", **links, "plot": f"{here}/plot.svg{query}"}
        return cls(revision=record.number, created=_moment(record.created), note=record.note, links=links, **more)


class RevisionDocument(RevisionEntry):
    """One revision of a result, whole."""

    segments: tuple[Segment, ...]


class RevisionList(_Answer):
    """Every revision of a result, the computed one first."""

    revisions: tuple[RevisionEntry, ...]


class ViewerDocument(_Answer):
    """What the page plays: `model`, `strain` and `materials` are addresses to read by Range; see formats/playback."""

    model_config = ConfigDict(extra="allow")

    kind: Literal["gltf", "vertices"]
    model: str
    strain: str | None
    materials: str | None = None
    frames: int
    frame_rate: float
    start_seconds: float = 0.0
    vertices: int
    triangles: int
    skeleton: bool = False
    patches: int = 0
