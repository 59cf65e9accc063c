"""The energy curve with its key-frames, the cuts, and the segments in colour."""

from caesura.core.plot.layout import lay_out_picture
from caesura.core.plot.svg import render_svg
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.exports.export_table import ExportSource
from caesura.formats.streamed_file import StreamedFile


def plot_svg(document: SegmentationDocument) -> str:
    """As SVG, to be pasted into a paper."""
    return render_svg(lay_out_picture(document))


def plot_png(source: ExportSource) -> StreamedFile:
    """As PNG."""
    from caesura.core.plot.png import render_png  # noqa: PLC0415  arrays, which a web process has not

    return StreamedFile("image/png", iter([render_png(lay_out_picture(source.document), source.font())]))
