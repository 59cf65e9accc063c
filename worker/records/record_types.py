"""The records that Redis holds of ours, as plain frozen values. Their keys are in `redis_keys`."""

from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, TypeAdapter

from caesura.core.parameters import Parameters
from caesura.core.segmentation_document import Segment

Status = Literal["queued", "running", "done", "failed", "cancelled"]
Queue = Literal["analyse", "cut"]


class Record(BaseModel):
    """A frozen value that Redis holds as JSON."""

    model_config = ConfigDict(frozen=True)

    @classmethod
    def read(cls, stored: bytes | str | None) -> Self | None:
        """The record of a stored value; None where there is none."""
        return None if stored is None else cls.model_validate_json(stored)


class Part(Record):
    """One file of an upload: its name, its blob, its size."""

    name: str
    key: str
    bytes: int


class TakeSummary(Record):
    """One animation of the file, as its header tells; the worker's count of frames holds."""

    index: int
    name: str
    duration_seconds: float
    frames: int
    frame_rate: float


TAKES: TypeAdapter[tuple[TakeSummary, ...]] = TypeAdapter(tuple[TakeSummary, ...])


class AnimationRecord(Record):
    """An uploaded file, but for its takes, which may be thousands and lie beside it.

    `created` is in seconds since 1970, `seconds` is the duration of the longest take. Without parts, its files were
    kept long enough and are gone; the record stays for its results, and the same bytes uploaded again take its place.
    `takes` is filled only by what an earlier version stored.
    """

    id: str
    owner: str = ""
    name: str
    format: str
    parts: tuple[Part, ...]
    takes: tuple[TakeSummary, ...] = ()
    take_count: int = 0
    seconds: float | None = None
    vertices: int | None = None
    triangles: int | None = None
    created: float


class ViewerRecord(Record):
    """What the page plays: the document that describes it, and the blobs of the model, its strain and its materials."""

    document: dict[str, Any]
    model: str
    strain: str | None = None
    materials: str | None = None


class AnalysisRecord(Record):
    """What was computed from the vertices: the blob of the analysis, and what the page plays."""

    key: str
    viewer: ViewerRecord | None = None

    def blobs(self) -> list[str]:
        """Every blob it points to."""
        shown = [] if self.viewer is None else [self.viewer.model, self.viewer.strain, self.viewer.materials]
        return [key for key in (self.key, *shown) if key is not None]


class ExportRecord(Record):
    """A file made of a result by a job, which `token` names: pending without a key or a problem.

    `created` is in seconds since 1970.
    """

    token: str = ""
    key: str | None = None
    media_type: str = ""
    created: float = 0.0
    problem: dict[str, Any] | None = None

    @property
    def pending(self) -> bool:
        """There is no file yet, and no reason why there will be none."""
        return self.key is None and self.problem is None


class DeliveryRecord(Record):
    """A call to be made because a segmentation is over: where to, of what, and how often it failed so far.

    It holds ids and no names. `finished` is in seconds since 1970.
    """

    id: str
    owner: str
    url: str
    segmentation: str
    animation: str
    status: Status
    problem: dict[str, Any] | None = None
    finished: float
    failures: int = 0


class UploadRecord(Record):
    """An upload that is not whole yet, or the animation that it has become. `expires` is in seconds since 1970."""

    id: str
    owner: str
    name: str
    length: int
    expires: float
    animation: str = ""


class RevisionRecord(Record):
    """A revision of a result, but for its segments, which may be many. `created` is in seconds since 1970."""

    number: int
    created: float
    note: str = ""


class SegmentationRecord(Record):
    """One way to cut an animation, and how far it is.

    queued -> running -> done | failed | cancelled. `token` names the current attempt: whoever holds another
    can no longer write. `problem` is what `CaesuraError.problem()` gave, or one of kind `worker`, which is not
    the file's fault: posting the same again then starts anew. `parameters` are complete, defaults filled in.
    Queued with a time `due`, in seconds since 1970, it gets its place in a queue then: it is tried again after a pause.
    `started` is when the current attempt began, `finished` when it ended, in seconds since 1970; 0 before that.
    `request` is the id of the request that asked for it first.
    `segments` are the computed ones; `revision` is the number of the newest revision of them, 0 without any.
    """

    id: str
    animation: str
    owner: str = ""
    name: str = ""
    request: str = ""
    parameters: dict[str, Any]
    algorithm: str
    status: Status = "queued"
    queue: Queue = "analyse"
    stage: str = ""
    fraction: float = 0.0
    attempt: int = 0
    token: str = ""
    due: float = 0.0
    problem: dict[str, Any] | None = None
    created: float
    updated: float
    started: float = 0.0
    finished: float = 0.0
    analysis: AnalysisRecord | None = None
    motions: int | None = None
    frames: int | None = None
    segments: tuple[Segment, ...] = ()
    revision: int = 0

    @property
    def live(self) -> bool:
        """Queued or running: it will still change."""
        return self.status in {"queued", "running"}

    @property
    def settled(self) -> bool:
        """Its answer would be the same again: done, or failed because of the file or the parameters."""
        return self.status == "done" or (self.status == "failed" and (self.problem or {}).get("kind") != "worker")

    def chosen(self) -> Parameters:
        """The parameters as core takes them."""
        return Parameters.model_validate(self.parameters)

    def with_changes(self, **changes: Any) -> "SegmentationRecord":
        """The same record but for `changes`."""
        return self.model_copy(update=changes)
