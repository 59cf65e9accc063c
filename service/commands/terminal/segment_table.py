"""A segmentation for a person to read in a terminal."""

from collections.abc import Iterator

from caesura.core.segmentation_document import SegmentationDocument
from caesura.worker.control_characters import escape_control_characters


def print_table(name: str, found: SegmentationDocument) -> str:
    """The headline, a line for each segment, then what the result warns of."""
    lines = [_headline(name, found), "", *_rows(found), *_warnings(found)]
    return "\n".join(map(escape_control_characters, lines))


def _headline(name: str, found: SegmentationDocument) -> str:
    motions = "1 motion" if found.motions == 1 else f"{found.motions} motions"
    segments = "1 segment" if len(found.segments) == 1 else f"{len(found.segments)} segments"
    take = f", take {found.source.name}" if found.source.name else ""
    return f"{name}{take}: {found.frames} frames at {found.frame_rate:g} a second, {motions} in {segments}"


def _rows(found: SegmentationDocument) -> Iterator[str]:
    names = max(len("motion"), *(len(segment.name) for segment in found.segments))
    yield f"  {'motion':<{names}}  {'frames':>15}  {'seconds':>19}  cut is sure"
    for segment in found.segments:
        frames = f"{segment.start:>6} … {segment.end:>6}"
        seconds = f"{segment.start_seconds:>8.2f} … {segment.end_seconds:>8.2f}"
        sure = "" if segment.confidence is None or segment.end == found.frames else f"{segment.confidence:.0%}"
        yield f"  {segment.name:<{names}}  {frames}  {seconds}  {sure:>5}".rstrip()


def _warnings(found: SegmentationDocument) -> Iterator[str]:
    if found.warnings:
        yield ""
    for warning in found.warnings:
        yield f"  warning: {warning.detail} [{warning.code}]"
