"""The result of cutting a take: labels for every frame, key-frames, cuts, and how sure each is."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from caesura.core.document import (
    Interval,
    KeyFrame,
    Notice,
    Score,
    Segment,
    SegmentationDocument,
    Source,
    motion_name,
)


@dataclass(frozen=True)
class Cut:
    """What a method answers: a motion for every frame and key-frame.

    `labels` (frames,) are any integers; `confidence` (cuts,), 0 to 1, one for each change of label in order.
    """

    labels: Int[np.ndarray, "frames"]
    key_frames: Int[np.ndarray, "keys"]
    confidence: Float[np.ndarray, "cuts"] | None = None
    scores: tuple[Score, ...] = ()
    notices: tuple[Notice, ...] = ()


@dataclass(frozen=True)
class Segmentation:
    """The motions of a take. `labels` are 0-based in order of first appearance, one per frame.

    `repeats` are the repetitions of each segment, or nothing where nobody looked for them.
    """

    method: str
    algorithm: str
    parameters: dict[str, Any]
    source: Source
    frame_rate: float
    labels: Int[np.ndarray, "frames"]
    energy: Float[np.ndarray, "frames"]
    key_frames: Int[np.ndarray, "keys"]
    confidence: Float[np.ndarray, "cuts"]
    scores: tuple[Score, ...] = ()
    notices: tuple[Notice, ...] = ()
    repeats: tuple[tuple[Interval, ...], ...] = ()

    @property
    def cuts(self) -> Int[np.ndarray, "cuts"]:
        """The first frame of every segment but the first."""
        return np.flatnonzero(np.diff(self.labels)) + 1

    @property
    def motions(self) -> int:
        """How many motions there are."""
        return int(self.labels.max()) + 1

    @property
    def segments(self) -> tuple[Segment, ...]:
        """Frames [start, end) of one motion each, tiling the take."""
        frames = len(self.labels)
        bounds = [0, *self.cuts.tolist(), frames]
        sure = [*self.confidence.tolist(), 1.0]
        repeats = self.repeats or ((),) * len(sure)
        last = self.source.start_seconds + (frames - 1) / self.frame_rate
        return tuple(
            Segment(
                start=start,
                end=end,
                start_seconds=self._seconds(start),
                end_seconds=min(self._seconds(end), last),
                motion=int(self.labels[start]),
                name=motion_name(int(self.labels[start])),
                repeats=repeated,
                confidence=round(float(confidence), 4),
            )
            for start, end, confidence, repeated in zip(bounds[:-1], bounds[1:], sure, repeats, strict=True)
        )

    def document(self, identifier: str | None = None) -> SegmentationDocument:
        """The same as plain values, ready for JSON."""
        frames = len(self.labels)
        return SegmentationDocument(
            id=identifier,
            algorithm=self.algorithm,
            method=self.method,
            parameters=self.parameters,
            source=self.source,
            frames=frames,
            frame_rate=self.frame_rate,
            duration_seconds=(frames - 1) / self.frame_rate,
            motions=self.motions,
            segments=self.segments,
            key_frames=tuple(
                KeyFrame(
                    frame=f,
                    seconds=self._seconds(f),
                    energy=float(self.energy[f]),
                    motion=int(self.labels[f]),
                )
                for f in self.key_frames.tolist()
            ),
            energy=tuple(None if value != value else round(value, 6) for value in self.energy.tolist()),
            scores=self.scores,
            warnings=self.notices,
        )

    def to_json(self, identifier: str | None = None) -> str:
        """The segmentation document."""
        return self.document(identifier).model_dump_json()

    def _seconds(self, frame: int) -> float:
        return self.source.start_seconds + frame / self.frame_rate


def number_by_appearance(labels: Int[np.ndarray, "frames"]) -> Int[np.ndarray, "frames"]:
    """The same grouping with labels 0, 1, … in the order in which they first appear."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    rank = np.empty(len(first), dtype=np.int64)
    rank[np.argsort(first, kind="stable")] = np.arange(len(first))
    return rank[inverse]
