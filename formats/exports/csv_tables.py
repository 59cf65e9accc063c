"""A row for each segment, or for each frame, as CSV."""

import csv
import io
from collections.abc import Iterable, Iterator

from caesura.core.segmentation_document import Segment, SegmentationDocument

SEGMENT_COLUMNS = ("name", "motion", "start", "end", "start_seconds", "end_seconds", "confidence", "loop", "discard")
FRAME_COLUMNS = ("frame", "seconds", "motion", "name", "energy", "key_frame")


def segments_csv(document: SegmentationDocument) -> str:
    """One row per segment: frames [start, end), seconds on the file's clock; `confidence` is empty where a person

    put the cut, `loop` and `discard` are 1 where a person has said so.
    """
    return _csv(
        SEGMENT_COLUMNS,
        (
            (s.name, s.motion, s.start, s.end, f"{s.start_seconds:.6f}", f"{s.end_seconds:.6f}", *_segment_row(s))
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


def _segment_row(segment: Segment) -> tuple[object, ...]:
    return "" if segment.confidence is None else segment.confidence, int(segment.loop), int(segment.discard)


def _csv(columns: Iterable[str], rows: Iterator[tuple[object, ...]]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return out.getvalue()
