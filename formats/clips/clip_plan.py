"""The plan of the clips: their names and times. Light: no NumPy."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from caesura.core.errors import ParameterError
from caesura.core.segmentation_document import Interval, Loop, Segment, SegmentationDocument
from caesura.formats.clips.clip_names import ClipSubject, name_clips
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.loop_choice import chosen_loops

MOST_OVER = 10
"""How many times as long as the take its clips may be together."""

SHORT_SECONDS = 600.0
"""So long they may be in any case."""


@dataclass(frozen=True)
class TakeFrames:
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
    """Frames [start_frame, end_frame) of segment number `segment`, from 1, and seconds [start, end] of the take.

    Handles are included in the seconds. `extras` go with the clip into the file. `loops`: it is played round and round;
    `loop` is where it was cut to its best loop.
    """

    name: str
    segment: int
    take: int
    start_frame: int
    end_frame: int
    start: float
    end: float
    extras: dict[str, Any]
    loops: bool = False
    loop: Loop | None = None


@dataclass(frozen=True)
class _Piece:
    """What of a segment lies in one take, and its seconds there; `loop` where it is cut to that."""

    segment: Segment
    number: int
    take_range: TakeFrames
    frames: Interval
    start: float
    end: float
    loop: Loop | None


def plan_clips(
    document: SegmentationDocument, options: ClipOptions, take_ranges: Sequence[TakeFrames], taken: Iterable[str] = ()
) -> tuple[Clip, ...]:
    """The clips of a result, beside animations whose names are `taken`.

    A clip ends where the next segment begins, so that one clip's last pose is the next one's first. Raises
    `ParameterError` for a motion that there is not, `no-clips` where nothing is left, and `handles-too-long`.
    """
    looping, discarded = (
        _check_motion_names(document, "loop", options.loop_names()),
        _check_motion_names(document, "discard", options.discard_names()),
    )
    _check_chosen(document, options)
    loops = chosen_loops(document) if options.finds_loops else {}
    pieces = [
        piece
        for number, segment in enumerate(document.segments, 1)
        if options.chooses(number)
        if segment.name not in discarded and (options.keep_discarded or not segment.discard)
        for part in _parts(segment, loops.get(number), options)
        for piece in _pieces_in_takes(document, number, part, take_ranges, loops.get(number))
        if piece.end - piece.start >= options.min_seconds
    ]
    if not pieces:
        raise ParameterError(
            "no-clips",
            "No clip is left: every segment is discarded, or shorter than min_seconds. Ask for less to be left out.",
            parameter="discard" if discarded else "min_seconds",
        )
    _is_long_enough(pieces, options, take_ranges)
    subjects = [
        ClipSubject(
            motion=piece.segment.name,
            segment=piece.number,
            take=document.source.name,
            loops=_loops(piece, looping),
        )
        for piece in pieces
    ]
    names = name_clips(subjects, taken, options.names)
    return tuple(
        _clip(document, options, name, piece, loops=_loops(piece, looping))
        for name, piece in zip(names, pieces, strict=True)
    )


def _is_long_enough(pieces: Sequence[_Piece], options: ClipOptions, take_ranges: Sequence[TakeFrames]) -> None:
    """Handles make clips overlap: many short ones with long handles are the take over and over again."""
    whole = sum(take_range.until - take_range.start for take_range in take_ranges)
    asked = sum(min(piece.end - piece.start + 2 * options.handles_seconds, whole) for piece in pieces)
    if options.handles_seconds and asked > max(MOST_OVER * whole, SHORT_SECONDS):
        detail = f"With these handles the clips of a take of {whole:.0f} seconds are {asked:.0f} seconds long together."
        raise ParameterError("handles-too-long", f"{detail} Ask for shorter ones.", parameter="handles_seconds")


def _loops(piece: _Piece, looping: set[str]) -> bool:
    return piece.loop is not None or piece.segment.loop or piece.segment.name in looping


def _clip(document: SegmentationDocument, options: ClipOptions, name: str, piece: _Piece, *, loops: bool) -> Clip:
    handles = 0.0 if piece.loop else options.handles_seconds
    extras = {
        "segmentation": document.id,
        "revision": document.revision or None,
        "motion": piece.segment.name,
        "start": piece.frames.start,
        "end": piece.frames.end,
        "start_seconds": round(piece.start, 6),
        "end_seconds": round(piece.end, 6),
        "handles_seconds": handles or None,
        "loop": piece.loop.model_dump(include={"cycles", "seam", "match"}) if piece.loop else None,
    }
    return Clip(
        name=name,
        segment=piece.number,
        take=piece.take_range.take,
        start_frame=piece.frames.start,
        end_frame=piece.frames.end,
        start=max(piece.start - handles, 0.0),
        end=min(piece.end + handles, max(piece.take_range.duration, piece.end)),
        extras={key: value for key, value in extras.items() if value is not None},
        loops=loops,
        loop=piece.loop,
    )


def _pieces_in_takes(
    document: SegmentationDocument,
    number: int,
    part: Interval,
    take_ranges: Sequence[TakeFrames],
    loop: Loop | None,
) -> Iterator[_Piece]:
    """A part of segment `number` in each take that it touches."""
    segment, rate = document.segments[number - 1], document.frame_rate
    for take_range in take_ranges:
        start, end = max(part.start, take_range.first), min(part.end, take_range.end)
        if start < end:
            begin = take_range.start + (start - take_range.first) / rate
            until = take_range.until if end == take_range.end else take_range.start + (end - take_range.first) / rate
            frames = Interval(start=start, end=end)
            yield _Piece(segment, number, take_range, frames, begin, min(until, take_range.until), loop)


def _check_chosen(document: SegmentationDocument, options: ClipOptions) -> None:
    """Raise `ParameterError` where a segment is asked for that there is not."""
    chosen = [number for number in range(1, len(document.segments) + 1) if options.chooses(number)]
    if options.only and not chosen:
        detail = f"There is no segment {options.only}. They are numbered from 1 to {len(document.segments)}."
        raise ParameterError("invalid-parameter", detail, parameter="only")


def _parts(segment: Segment, loop: Loop | None, options: ClipOptions) -> tuple[Interval, ...]:
    """What of a segment becomes clips: its loop, its repetitions, or all of it."""
    if loop is not None:
        return (Interval(start=loop.start, end=loop.end),)
    whole = (Interval(start=segment.start, end=segment.end),)
    return segment.repeats or whole if options.split_repeats else whole


def _check_motion_names(document: SegmentationDocument, parameter: str, names: set[str]) -> set[str]:
    known = {segment.name for segment in document.segments}
    for name in sorted(names - known):
        listed = ", ".join(sorted(known)[:20])
        raise ParameterError(
            "unknown-motion", f"There is no motion {name!r}. There are: {listed}.", parameter=parameter
        )
    return names
