"""The segmentation document: the JSON that the service stores, the command prints and programs read.

New keys may come; these keep their meaning. Frames are 0-based, intervals half-open, seconds are on the file's
own clock. Light: no NumPy, so that the web process can read, check and describe it.
"""

from typing import Any

from pydantic import BaseModel, ConfigDict, Field


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


class Segment(_Value):
    """Frames [start, end) of one motion. Segments tile [0, frames) exactly.

    `end_seconds` is the time of the next segment's first frame, at most the duration. `confidence`, 0 to 1, is
    how sure the cut at `end` is; the last segment ends with the take and has 1; null where a person put the cut.
    `repeats` tile the segment: one interval for each time the motion is performed, and the whole segment where
    nothing repeats. `loop` and `discard` are a person's word to who makes clips: this one goes round, that one is none.
    """

    start: int
    end: int
    start_seconds: float
    end_seconds: float
    motion: int = Field(description="0-based, in order of first appearance")
    name: str
    repeats: tuple[Interval, ...] = ()
    confidence: float | None = Field(1.0, ge=0, le=1)
    loop: bool = False
    discard: bool = False


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
    warnings: tuple[Notice, ...] = ()


def motion_name(motion: int) -> str:
    """A, B, … Z, AA, AB, …: the name of a motion that nobody has named."""
    name = ""
    motion += 1
    while motion:
        motion, digit = divmod(motion - 1, 26)
        name = chr(ord("A") + digit) + name
    return name
