"""What the API answers with, described once: the fields, and how they come from the records."""

from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field

from caesura.core.document import Segment
from caesura.worker.records.schema import AnimationRecord, RevisionRecord, SegmentationRecord, Status, TakeSummary


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
    created: float = Field(description="seconds since 1970")
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
            created=record.created,
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
    """What is being done, and how much of that is done, 0 to 1."""

    stage: str
    fraction: float


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
            progress=StageProgress(stage=record.stage, fraction=record.fraction),
            problem=record.problem,
            motions=record.motions if done else None,
            frames=record.frames if done else None,
            segments=record.segments if done else None,
            revision=record.revision,
            links=_links(record.id),
        )


class SegmentationPage(_Answer):
    """Segmentations without their segments, newest first; `next` is the address of the page after this one."""

    segmentations: tuple[StatusDocument, ...]
    next: str | None = None


def _links(identifier: str) -> dict[str, str]:
    here = f"/v1/segmentations/{identifier}"
    named = {name: f"{here}/{name}" for name in ("events", "result", "revisions", "clips", "keyframes", "viewer")}
    return {"self": here, **named, "plot": f"{here}/plot.svg", "page": f"/view/{identifier}"}


class RevisionEntry(_Answer):
    """One revision of a result, but for its segments; revision 0 is the result as computed."""

    revision: int
    created: float = Field(description="seconds since 1970")
    note: str
    links: dict[str, str]

    @classmethod
    def of(cls, identifier: str, record: RevisionRecord, **more: Any) -> Self:
        """The answer for a record."""
        here, query = f"/v1/segmentations/{identifier}", f"?revision={record.number}"
        links = {name: f"{here}/{name}{query}" for name in ("result", "clips", "keyframes")}
        links = {"self": f"{here}/revisions/{record.number}", **links, "plot": f"{here}/plot.svg{query}"}
        return cls(revision=record.number, created=record.created, note=record.note, links=links, **more)


class RevisionDocument(RevisionEntry):
    """One revision of a result, whole."""

    segments: tuple[Segment, ...]


class RevisionList(_Answer):
    """Every revision of a result, the computed one first."""

    revisions: tuple[RevisionEntry, ...]


class ViewerDocument(_Answer):
    """What the page plays: `model` and `strain` are addresses to read by Range; see core/formats/playback."""

    model_config = ConfigDict(extra="allow")

    kind: Literal["gltf", "vertices"]
    model: str
    strain: str | None
    frames: int
    frame_rate: float
    start_seconds: float = 0.0
    vertices: int
    triangles: int
    skeleton: bool = False
    patches: int = 0
