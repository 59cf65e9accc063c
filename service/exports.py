"""Text forms of a result, written from the stored document: no array is needed, so the web process does it."""

import csv
import io
from collections.abc import Iterable, Iterator

from core.document import Segment, SegmentationDocument

SEGMENT_COLUMNS = ("name", "motion", "start", "end", "start_seconds", "end_seconds")
FRAME_COLUMNS = ("frame", "seconds", "motion", "name", "energy", "key_frame")


def segments_csv(document: SegmentationDocument) -> str:
    """One row per segment: frames [start, end), seconds on the file's clock."""
    return _csv(
        SEGMENT_COLUMNS,
        (
            (s.name, s.motion, s.start, s.end, f"{s.start_seconds:.6f}", f"{s.end_seconds:.6f}")
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
    cues = (f"{_clock(s.start_seconds)} --> {_clock(s.end_seconds)}\n{_plain(s)}\n" for s in document.segments)
    return "WEBVTT\n\n" + "\n".join(cues)


def _csv(columns: Iterable[str], rows: Iterator[tuple[object, ...]]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return out.getvalue()


def _plain(segment: Segment) -> str:
    """A name that cannot be taken for markup or for the next cue."""
    return " ".join(segment.name.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").split())


def _clock(seconds: float) -> str:
    whole, milliseconds = divmod(round(max(seconds, 0.0) * 1000), 1000)
    return f"{whole // 3600:02}:{whole // 60 % 60:02}:{whole % 60:02}.{milliseconds:03}"
