"""The segmentation document: the JSON that the service stores, the command prints and programs read.

New keys may come; these keep their meaning. Frames are 0-based, intervals half-open, seconds are on the file's
own clock. Light: no NumPy, so that the web process can read, check and describe it.
"""

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

SHOWN_SEGMENTS = 8
"""Segments in the second line of a result that is printed; of more, the rest are counted."""


class _Value(BaseModel):
    model_config = ConfigDict(frozen=True)


class Notice(_Value):
    """A warning that is part of the result: what was assumed, left out or could not be honoured."""

    code: str = Field(examples=["frame-rate-assumed"])
    detail: str


class Source(_Value):
    """Where the frames come from: the take, its name, the rate of sampling and the time of frame 0."""

    take: int
    name: str
    fps: float
    start_seconds: float = 0.0


class Interval(_Value):
    """Frames [start, end)."""

    start: int
    end: int


class Loop(_Value):
    """Frames `start` to `end` of a segment, to be played round: the pose at `end` is the one at `start` again.

    `cycles` repetitions lie between. `seam` is how far both poses are apart, in steps between neighbouring frames:
    up to 2 steps, as at twice the speed, the match is good; up to 4 it is fair.
    """

    start: int
    end: int
    cycles: int = Field(ge=1)
    seam: float = Field(ge=0)
    match: Literal["good", "fair", "poor"]


class Segment(_Value):
    """Frames [start, end) of one motion. Segments tile [0, frames) exactly.

    `end_seconds` is the time of the next segment's first frame, at most the duration. `confidence`, 0 to 1, is
    how sure the cut at `end` is; the last segment ends with the take and has 1; null where a person put the cut.
    `repeats` tile the segment: one interval for each time the motion is performed, and the whole segment where
    nothing repeats; `best_loop` is the best loop of it, where there is one. `loop` and `discard` are a person's word
    to who makes clips: this one goes round, that one is none.
    """

    start: int
    end: int
    start_seconds: float
    end_seconds: float
    motion: int = Field(description="0-based, in order of first appearance")
    name: str
    repeats: tuple[Interval, ...] = ()
    best_loop: Loop | None = None
    confidence: float | None = Field(1.0, ge=0, le=1)
    loop: bool = False
    discard: bool = False


class Candidate(_Value):
    """A frame at which a cut may be missing, so that the segment around it would be two motions, and how likely."""

    frame: int
    seconds: float
    likelihood: float = Field(ge=0, le=1)


class KeyFrame(_Value):
    """A local maximum of the energy curve, and the motion it is of."""

    frame: int
    seconds: float
    energy: float
    motion: int


class Score(_Value):
    """How well the take is explained by so many motions: the cost left, as a share of the cost of one motion."""

    motions: int
    score: float


class VarianceCurve(_Value):
    """ξ of Eq. 5 at the frames `start`, `start` + 1, … between two key-frames of different motions.

    `boundary` is the frame at which it is least, and the motion changes.
    """

    start: int
    boundary: int
    values: tuple[float, ...]


class KeyFrameCluster(_Value):
    """Key-frames of one motion, and the mean of their normalised strains (Eq. 4), 0 to 1.

    `strain` has a mean for every triangle of the take, in its order (0 where a triangle has no area at rest), and is
    empty where there are too many of them or none; `mean_strain` is the mean over all that is measured.
    """

    key_frames: tuple[int, ...]
    mean_strain: float
    strain: tuple[float, ...] = ()


class SegmentationDocument(_Value):
    """The whole result."""

    id: str | None = None
    revision: int = Field(0, ge=0, description="0: as computed; else the number of the revision by a person")
    algorithm: str
    method: str
    parameters: dict[str, Any]
    source: Source
    frames: int
    frame_rate: float
    duration_seconds: float
    motions: int
    segments: tuple[Segment, ...]
    key_frames: tuple[KeyFrame, ...]
    energy: tuple[float | None, ...] = Field(description="nats; null where the windows of Eq. 3 do not fit")
    scores: tuple[Score, ...] = ()
    kind: Literal["performance", "sheet"] = Field("performance", description="what the take was taken for")
    transitions: tuple[Interval, ...] = Field((), description="frames on the way from one motion to the next")
    candidates: tuple[Candidate, ...] = Field((), description="where a cut may be missing, the likeliest first")
    variances: tuple[VarianceCurve, ...] = Field((), description="curves of Eq. 5, where `details` were asked for")
    clusters: tuple[KeyFrameCluster, ...] = Field(
        (), description="the key-frames of each motion and their mean strain (Eq. 4), where `details` were asked for"
    )
    warnings: tuple[Notice, ...] = ()

    def __repr__(self) -> str:
        return f"<SegmentationDocument: {summarise(self)}>"

    __str__ = __repr__


def summarise(document: SegmentationDocument) -> str:
    """Two lines for a person: what was found, and the first segments."""
    motions = "1 motion" if document.motions == 1 else f"{document.motions} motions"
    segments = "1 segment" if len(document.segments) == 1 else f"{len(document.segments)} segments"
    shown = [f"{one.name} {one.start}:{one.end}" for one in document.segments[:SHOWN_SEGMENTS]]
    rest = len(document.segments) - SHOWN_SEGMENTS
    more = [f"… {rest} more"] if rest > 0 else []
    rate = f"{document.frames} frames at {document.frame_rate:g} a second"
    return f"{rate}, {motions} in {segments} by {document.method}\n {', '.join(shown + more)}"


def motion_name(motion: int) -> str:
    """A, B, … Z, AA, AB, …: the name of a motion that nobody has named."""
    name = ""
    motion += 1
    while motion:
        motion, digit = divmod(motion - 1, 26)
        name = chr(ord("A") + digit) + name
    return name
