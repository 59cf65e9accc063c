"""The result as HTML, as a notebook shows it: the curve over the segments, and a row for each segment."""

from collections.abc import Iterator

from caesura.core.plot.layout import COLOURS, lay_out_picture
from caesura.core.plot.svg import plain_text, render_svg
from caesura.core.segmentation_document import Segment, SegmentationDocument

MOST_ROWS = 40
"""Segments that are listed; of more, the rest are counted."""

CELL = "text-align:left;padding:2px 12px 2px 0"
HEADINGS = ("motion", "frames", "seconds", "times", "cut is sure")


def render_html(document: SegmentationDocument) -> str:
    """A picture and a table. Names are text there and nothing else."""
    motions = "1 motion" if document.motions == 1 else f"{document.motions} motions"
    headline = f"{document.frames} frames at {document.frame_rate:g} a second, {motions} by {document.method}"
    heads = "".join(f'<th style="{CELL}">{heading}</th>' for heading in HEADINGS)
    rest = len(document.segments) - MOST_ROWS
    parts = [
        '<div style="max-width:960px;overflow-x:auto">',
        f"<p>{plain_text(headline)}</p>",
        render_svg(lay_out_picture(document)),
        f"<table><thead><tr>{heads}</tr></thead><tbody>",
        *(_row(segment, segment.end == document.frames) for segment in document.segments[:MOST_ROWS]),
        "</tbody></table>",
        *([f"<p>… and {rest} more segments</p>"] if rest > 0 else []),
        *(f"<p>Warning: {plain_text(warning.detail)}</p>" for warning in document.warnings),
        "</div>",
    ]
    return "\n".join(parts)


def _row(segment: Segment, is_last: bool) -> str:
    return "<tr>" + "".join(f'<td style="{CELL}">{cell}</td>' for cell in _cells(segment, is_last)) + "</tr>"


def _cells(segment: Segment, is_last: bool) -> Iterator[str]:
    colour = COLOURS[segment.motion % len(COLOURS)]
    chip = f'<span style="display:inline-block;width:0.8em;height:0.8em;background:{colour}"></span>'
    yield f"{chip} {plain_text(segment.name)}"
    yield f"{segment.start} … {segment.end}"
    yield f"{segment.start_seconds:.2f} … {segment.end_seconds:.2f}"
    yield str(max(len(segment.repeats), 1))
    yield "" if segment.confidence is None or is_last else f"{segment.confidence:.0%}"
