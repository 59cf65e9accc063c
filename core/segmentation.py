"""The result of cutting a take: labels for every frame, key-frames, cuts, and how sure each is."""

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from jaxtyping import Float, Int

from caesura.core.plot.data_frame import export_columns, make_data_frame
from caesura.core.segmentation_document import (
    Candidate,
    Interval,
    KeyFrame,
    KeyFrameCluster,
    Loop,
    Notice,
    Score,
    Segment,
    SegmentationDocument,
    Source,
    VarianceCurve,
    motion_name,
    summarise,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Cut:
    """What a method answers: a motion for every frame and key-frame.

    `labels` (frames,) are any integers; `confidence` (cuts,), 0 to 1, one for each change of label in order.
    `transitions` are frames [start, end) between motions; `candidates` frames where a cut may be missing, and how
    likely, 0 to 1. `variances` and `clusters` are what `joint-entropy` saw on its way (Eq. 5 and 4).
    """

    labels: Int[np.ndarray, "frames"]
    key_frames: Int[np.ndarray, "keys"]
    confidence: Float[np.ndarray, "cuts"] | None = None
    scores: tuple[Score, ...] = ()
    notices: tuple[Notice, ...] = ()
    kind: Literal["performance", "sheet"] = "performance"
    transitions: tuple[tuple[int, int], ...] = ()
    candidates: tuple[tuple[int, float], ...] = ()
    variances: tuple[VarianceCurve, ...] = ()
    clusters: tuple[KeyFrameCluster, ...] = ()


@dataclass(frozen=True, eq=False, repr=False)
class Segmentation:
    """The motions of a take. `labels` are 0-based in order of first appearance, one per frame.

    `repeats` are the repetitions of each segment, or nothing where nobody looked for them. Two results are equal where
    all of their values are. A notebook shows a result as the curve over its segments, and a table of them.
    `repeats` are the repetitions of each segment and `loops` its best loop, or nothing where nobody looked for them.
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
    loops: tuple[Loop | None, ...] = ()
    kind: Literal["performance", "sheet"] = "performance"
    transitions: tuple[tuple[int, int], ...] = ()
    candidates: tuple[tuple[int, float], ...] = ()
    variances: tuple[VarianceCurve, ...] = ()
    clusters: tuple[KeyFrameCluster, ...] = ()

    @property
    def cuts(self) -> Int[np.ndarray, "cuts"]:
        """The first frame of every segment but the first."""
        return np.flatnonzero(np.diff(self.labels)) + 1

    @property
    def change_points(self) -> list[int]:
        """The end of every segment, the last of them the number of frames: what `predict` of ruptures answers."""
        return [*self.cuts.tolist(), len(self.labels)]

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
        loops = self.loops or (None,) * len(sure)
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
                best_loop=loop,
                confidence=round(float(confidence), 4),
            )
            for start, end, confidence, repeated, loop in zip(
                bounds[:-1], bounds[1:], sure, repeats, loops, strict=True
            )
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
            kind=self.kind,
            transitions=tuple(Interval(start=start, end=end) for start, end in self.transitions),
            candidates=tuple(
                Candidate(frame=frame, seconds=self._seconds(frame), likelihood=round(likely, 4))
                for frame, likely in self.candidates
            ),
            variances=self.variances,
            clusters=self.clusters,
            warnings=self.notices,
        )

    @classmethod
    def of(cls, document: SegmentationDocument) -> "Segmentation":
        """The result that a document states, of the command or a service; names and marks by a person are left out.

        A document rounds energies but those of key-frames to six places, and confidence to four.
        """
        lengths = [segment.end - segment.start for segment in document.segments]
        cuts = document.segments[:-1]
        energy = np.array([np.nan if value is None else value for value in document.energy], np.float64)
        for key in document.key_frames:
            energy[key.frame] = key.energy
        return cls(
            method=document.method,
            algorithm=document.algorithm,
            parameters=document.parameters,
            source=document.source,
            frame_rate=document.frame_rate,
            labels=number_by_appearance(np.repeat([segment.motion for segment in document.segments], lengths)),
            energy=energy,
            key_frames=np.array([key.frame for key in document.key_frames], np.int64),
            confidence=np.array([1.0 if one.confidence is None else one.confidence for one in cuts], np.float64),
            scores=document.scores,
            notices=document.warnings,
            repeats=tuple(segment.repeats for segment in document.segments),
            loops=tuple(segment.best_loop for segment in document.segments),
            kind=document.kind,
            transitions=tuple((one.start, one.end) for one in document.transitions),
            candidates=tuple((one.frame, one.likelihood) for one in document.candidates),
            variances=document.variances,
            clusters=document.clusters,
        )

    def to_json(self, identifier: str | None = None) -> str:
        """The segmentation document."""
        return self.document(identifier).model_dump_json()

    def to_frame(self, rows: str = "segments", library: str = "auto") -> Any:
        """A data frame with a row for each of the `segments`, the `frames` or the `key_frames`.

        `library` is "pandas", "polars", or "auto": the first that is installed. Raises ImportError without it.
        """
        return make_data_frame(export_columns(self.document(), rows), library)

    def to_aeon(self, form: Literal["dense", "sparse"] = "dense") -> list[int] | Int[np.ndarray, "frames"]:
        """As a segmenter of aeon answers: `dense`, the first frames of all segments but the first; `sparse`, labels."""
        return self.cuts.tolist() if form == "dense" else self.labels.copy()

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the curve over the segments with matplotlib, on `axes` or on new ones; raises ImportError without it."""
        from caesura.core.plot.matplotlib_figure import draw_figure  # noqa: PLC0415  only who draws needs it

        return draw_figure(self.document(), axes)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Segmentation):
            return NotImplemented
        return all(_equal_values(getattr(self, one.name), getattr(other, one.name)) for one in fields(self))

    def __hash__(self) -> int:
        return hash((self.method, self.algorithm, self.source, self.labels.tobytes()))

    def __repr__(self) -> str:
        return f"<Segmentation: {summarise(self.document())}>"

    def _repr_html_(self) -> str:
        from caesura.core.plot.notebook import render_html  # noqa: PLC0415  only a notebook needs it

        return render_html(self.document())

    def _seconds(self, frame: int) -> float:
        return self.source.start_seconds + frame / self.frame_rate


def _equal_values(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    return bool(one == other)


def number_by_appearance(labels: Int[np.ndarray, "frames"]) -> Int[np.ndarray, "frames"]:
    """The same grouping with labels 0, 1, … in the order in which they first appear."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    rank = np.empty(len(first), dtype=np.int64)
    rank[np.argsort(first, kind="stable")] = np.arange(len(first))
    return rank[inverse]
