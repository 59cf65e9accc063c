"""Which clips there will be: their names and their seconds. Light: no NumPy."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from core.document import Interval, Segment, SegmentationDocument
from core.errors import ParameterError
from core.formats.clips.names import numbered
from core.formats.clips.options import ClipOptions


@dataclass(frozen=True)
class Clip:
    """Frames [start_frame, end_frame) of the take, and its seconds [start, end], handles included.

    Seconds are counted from the take's frame 0. `extras` go with the clip into the file.
    """

    name: str
    start_frame: int
    end_frame: int
    start: float
    end: float
    extras: dict[str, Any]


def plan(
    document: SegmentationDocument, options: ClipOptions, duration: float, taken: Iterable[str] = ()
) -> tuple[Clip, ...]:
    """The clips of a take that is `duration` seconds long, beside animations whose names are `taken`.

    A clip ends where the next segment begins, so that one clip's last pose is the next one's first. Raises
    `ParameterError` for a motion that there is not, and `no-clips` where nothing is left.
    """
    looping, discarded = _known(document, "loop", options.looping()), _known(document, "discard", options.discarded())
    kept = [
        (segment, part)
        for segment in document.segments
        if segment.name not in discarded
        for part in _parts(segment, options.split_repeats)
        if _seconds(document, part, duration)[1] - _seconds(document, part, duration)[0] >= options.min_seconds
    ]
    if not kept:
        raise ParameterError(
            "no-clips",
            "No clip is left: every segment is discarded, or shorter than min_seconds. Ask for less to be left out.",
            parameter="discard" if discarded else "min_seconds",
        )
    names = numbered(((segment.name, segment.name in looping) for segment, _ in kept), taken)
    return tuple(
        _clip(document, options, duration, name, segment, part)
        for name, (segment, part) in zip(names, kept, strict=True)
    )


def _clip(
    document: SegmentationDocument, options: ClipOptions, duration: float, name: str, segment: Segment, part: Interval
) -> Clip:
    start, end = _seconds(document, part, duration)
    origin = document.source.start_seconds
    extras = {
        "segmentation": document.id,
        "motion": segment.name,
        "start": part.start,
        "end": part.end,
        "start_seconds": round(origin + start, 6),
        "end_seconds": round(origin + end, 6),
    }
    if options.handles_seconds:
        extras["handles_seconds"] = options.handles_seconds
    return Clip(
        name=name,
        start_frame=part.start,
        end_frame=part.end,
        start=max(start - options.handles_seconds, 0.0),
        end=min(end + options.handles_seconds, duration),
        extras={key: value for key, value in extras.items() if value is not None},
    )


def _seconds(document: SegmentationDocument, part: Interval, duration: float) -> tuple[float, float]:
    """[start / rate, end / rate], the last one to the end of the take, which need not be on a frame."""
    end = duration if part.end >= document.frames else min(part.end / document.frame_rate, duration)
    return part.start / document.frame_rate, end


def _parts(segment: Segment, split: bool) -> tuple[Interval, ...]:
    return segment.repeats if split and segment.repeats else (Interval(start=segment.start, end=segment.end),)


def _known(document: SegmentationDocument, parameter: str, names: set[str]) -> set[str]:
    known = {segment.name for segment in document.segments}
    for name in sorted(names - known):
        listed = ", ".join(sorted(known)[:20])
        raise ParameterError(
            "unknown-motion", f"There is no motion {name!r}. There are: {listed}.", parameter=parameter
        )
    return names
