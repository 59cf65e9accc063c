"""Text forms of a result, written from the stored document: no array is needed, so the web process does it."""

import csv
import io
from collections.abc import Iterable, Iterator

from caesura.core.document import Segment, SegmentationDocument
from caesura.core.plot.layout import lay_out_picture
from caesura.core.plot.svg import render_svg

SEGMENT_COLUMNS = ("name", "motion", "start", "end", "start_seconds", "end_seconds", "confidence", "loop", "discard")
FRAME_COLUMNS = ("frame", "seconds", "motion", "name", "energy", "key_frame")


def segments_csv(document: SegmentationDocument) -> str:
    """One row per segment: frames [start, end), seconds on the file's clock; `confidence` is empty where a person

    put the cut, `loop` and `discard` are 1 where a person has said so.
    """
    return _csv(
        SEGMENT_COLUMNS,
        (
            (s.name, s.motion, s.start, s.end, f"{s.start_seconds:.6f}", f"{s.end_seconds:.6f}", *_said(s))
            for s in document.segments
        ),
    )


def frames_csv(document: SegmentationDocument) -> str:
    """One row per frame; `energy` is empty where the windows do not fit, `key_frame` is 1 on key-frames."""
    keys = {key.frame for key in document.key_frames}
    start, rate = document.source.start_seconds, document.frame_rate
    return _csv(
        FRAME_COLUMNS,
        (
            (
                frame,
                f"{start + frame / rate:.6f}",
                segment.motion,
                segment.name,
                "" if (energy := document.energy[frame]) is None else energy,
                int(frame in keys),
            )
            for segment in document.segments
            for frame in range(segment.start, segment.end)
        ),
    )


def segments_vtt(document: SegmentationDocument) -> str:
    """WebVTT: one cue per segment, as video players and annotation tools read them."""
    return "WEBVTT\n\n" + "\n".join(map(_cue, document.segments))


def plot_svg(document: SegmentationDocument) -> str:
    """The energy curve over the segments, to be pasted into a paper."""
    return render_svg(lay_out_picture(document))


def _said(segment: Segment) -> tuple[object, ...]:
    return "" if segment.confidence is None else segment.confidence, int(segment.loop), int(segment.discard)


def _csv(columns: Iterable[str], rows: Iterator[tuple[object, ...]]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return out.getvalue()


def _cue(segment: Segment) -> str:
    """A cue must last, so a segment of the last frame alone gets a millisecond."""
    start, end = (round(max(seconds, 0.0) * 1000) for seconds in (segment.start_seconds, segment.end_seconds))
    return f"{_clock(start)} --> {_clock(max(end, start + 1))}\n{_plain(segment)}\n"


def _plain(segment: Segment) -> str:
    """A name that cannot be taken for markup or for the next cue."""
    return " ".join(segment.name.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").split())


def _clock(milliseconds: int) -> str:
    seconds, rest = divmod(milliseconds, 1000)
    return f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}.{rest:03}"
