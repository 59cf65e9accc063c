"""The segments as WebVTT, for video players and annotation tools."""

from caesura.core.segmentation_document import Segment, SegmentationDocument


def segments_vtt(document: SegmentationDocument) -> str:
    """WebVTT: one cue per segment, as video players and annotation tools read them."""
    return "WEBVTT\n\n" + "\n".join(map(_cue, document.segments))


def _cue(segment: Segment) -> str:
    """A cue must last, so a segment of the last frame alone gets a millisecond."""
    start, end = (round(max(seconds, 0.0) * 1000) for seconds in (segment.start_seconds, segment.end_seconds))
    return f"{_clock(start)} --> {_clock(max(end, start + 1))}\n{_plain(segment)}\n"


def _plain(segment: Segment) -> str:
    """A name that cannot be taken for markup or for the next cue; and whether a person has discarded the segment."""
    name = " ".join(segment.name.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").split())
    return name + (" (discarded)" if segment.discard else "")


def _clock(milliseconds: int) -> str:
    seconds, rest = divmod(milliseconds, 1000)
    return f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}.{rest:03}"
