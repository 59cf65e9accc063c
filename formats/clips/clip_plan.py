"""Which clips there will be: their names and their seconds. Light: no NumPy."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from caesura.core.document import Interval, Segment, SegmentationDocument
from caesura.core.errors import ParameterError
from caesura.formats.clips.clip_names import number_repeated_names
from caesura.formats.clips.clip_options import ClipOptions

MOST_OVER = 10
"""How many times as long as the take its clips may be together."""

SHORT_SECONDS = 600.0
"""So long they may be in any case."""


@dataclass(frozen=True)
class TakeRange:
    """Frames [first, end) of the result are of one take, the first of them at second `start` of its clock.

    The last of them stands until second `until`, which need not be on a frame; the take has seconds [0, duration].
    """

    take: int
    first: int
    end: int
    start: float
    until: float
    duration: float


@dataclass(frozen=True)
class Clip:
    """Frames [start_frame, end_frame) of the result, and seconds [start, end] of the take, handles included.

    `extras` go with the clip into the file.
    """

    name: str
    take: int
    start_frame: int
    end_frame: int
    start: float
    end: float
    extras: dict[str, Any]


@dataclass(frozen=True)
class _Piece:
    """What of a segment lies in one take, and its seconds there."""

    segment: Segment
    stretch: TakeRange
    frames: Interval
    start: float
    end: float


def plan_clips(
    document: SegmentationDocument, options: ClipOptions, stretches: Sequence[TakeRange], taken: Iterable[str] = ()
) -> tuple[Clip, ...]:
    """The clips of a result, beside animations whose names are `taken`.

    A clip ends where the next segment begins, so that one clip's last pose is the next one's first. Raises
    `ParameterError` for a motion that there is not, `no-clips` where nothing is left, and `handles-too-long`.
    """
    looping, discarded = (
        _check_motion_names(document, "loop", options.looping()),
        _check_motion_names(document, "discard", options.discarded()),
    )
    pieces = [
        piece
        for segment in document.segments
        if segment.name not in discarded and (options.keep_discarded or not segment.discard)
        for part in _parts(segment, options.split_repeats)
        for piece in _pieces(document, segment, part, stretches)
        if piece.end - piece.start >= options.min_seconds
    ]
    if not pieces:
        raise ParameterError(
            "no-clips",
            "No clip is left: every segment is discarded, or shorter than min_seconds. Ask for less to be left out.",
            parameter="discard" if discarded else "min_seconds",
        )
    _is_long_enough(pieces, options, stretches)
    names = number_repeated_names(
        ((piece.segment.name, piece.segment.loop or piece.segment.name in looping) for piece in pieces), taken
    )
    return tuple(_clip(document, options, name, piece) for name, piece in zip(names, pieces, strict=True))


def _is_long_enough(pieces: Sequence[_Piece], options: ClipOptions, stretches: Sequence[TakeRange]) -> None:
    """Handles make clips overlap: many short ones with long handles are the take over and over again."""
    whole = sum(stretch.until - stretch.start for stretch in stretches)
    asked = sum(min(piece.end - piece.start + 2 * options.handles_seconds, whole) for piece in pieces)
    if options.handles_seconds and asked > max(MOST_OVER * whole, SHORT_SECONDS):
        detail = f"With these handles the clips of a take of {whole:.0f} seconds are {asked:.0f} seconds long together."
        raise ParameterError("handles-too-long", f"{detail} Ask for shorter ones.", parameter="handles_seconds")


def _clip(document: SegmentationDocument, options: ClipOptions, name: str, piece: _Piece) -> Clip:
    extras = {
        "segmentation": document.id,
        "revision": document.revision or None,
        "motion": piece.segment.name,
        "start": piece.frames.start,
        "end": piece.frames.end,
        "start_seconds": round(piece.start, 6),
        "end_seconds": round(piece.end, 6),
        "handles_seconds": options.handles_seconds or None,
    }
    return Clip(
        name=name,
        take=piece.stretch.take,
        start_frame=piece.frames.start,
        end_frame=piece.frames.end,
        start=max(piece.start - options.handles_seconds, 0.0),
        end=min(piece.end + options.handles_seconds, max(piece.stretch.duration, piece.end)),
        extras={key: value for key, value in extras.items() if value is not None},
    )


def _pieces(
    document: SegmentationDocument, segment: Segment, part: Interval, stretches: Sequence[TakeRange]
) -> Iterator[_Piece]:
    """A part of a segment in each take that it touches."""
    rate = document.frame_rate
    for stretch in stretches:
        start, end = max(part.start, stretch.first), min(part.end, stretch.end)
        if start < end:
            begin = stretch.start + (start - stretch.first) / rate
            until = stretch.until if end == stretch.end else stretch.start + (end - stretch.first) / rate
            yield _Piece(segment, stretch, Interval(start=start, end=end), begin, min(until, stretch.until))


def _parts(segment: Segment, split: bool) -> tuple[Interval, ...]:
    return segment.repeats if split and segment.repeats else (Interval(start=segment.start, end=segment.end),)


def _check_motion_names(document: SegmentationDocument, parameter: str, names: set[str]) -> set[str]:
    known = {segment.name for segment in document.segments}
    for name in sorted(names - known):
        listed = ", ".join(sorted(known)[:20])
        raise ParameterError(
            "unknown-motion", f"There is no motion {name!r}. There are: {listed}.", parameter=parameter
        )
    return names
