"""The result as a figure of matplotlib, to be changed and combined there."""

from typing import TYPE_CHECKING

from caesura.core.plot.layout import CALM, COLOURS, INK, KEY, VARIANCE, curve_name
from caesura.core.segmentation_document import SegmentationDocument

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHADE = 0.45
"""How much of a motion's colour lies behind the curve."""


def draw_figure(document: SegmentationDocument, axes: "Axes | None" = None) -> "Axes":
    """The energy curve over the segments, seconds to the right, on `axes` or on new ones.

    Key-frames are dots; every motion has its colour, as in the page, and its name in the legend; variances (Eq. 5) are
    below. Raises ImportError where matplotlib is not installed.
    """
    try:
        from matplotlib import pyplot  # noqa: PLC0415  an extra
    except ModuleNotFoundError as missing:
        raise ImportError('A plot needs matplotlib: pip install "caesura[plot]".') from missing

    if axes is None:
        _, axes = pyplot.subplots(figsize=(9.6, 3), layout="constrained")
    start, rate = document.source.start_seconds, document.frame_rate
    named: set[str] = set()
    for segment in document.segments:
        label = "_" if segment.name in named else segment.name
        named.add(segment.name)
        colour = COLOURS[segment.motion % len(COLOURS)]
        axes.axvspan(
            start + segment.start / rate, start + segment.end / rate, color=colour, alpha=SHADE, lw=0, label=label
        )
    energy = [float("nan") if value is None else value for value in document.energy]
    axes.plot([start + frame / rate for frame in range(document.frames)], energy, color=INK, lw=1.2)
    axes.plot([key.seconds for key in document.key_frames], [key.energy for key in document.key_frames], "o", color=KEY)
    for curve in document.variances:
        low, high = min(curve.values), max(curve.values)
        seconds = [start + (curve.start + i) / rate for i in range(len(curve.values))]
        heights = [VARIANCE * (value - low) / ((high - low) or 1.0) for value in curve.values]
        axes.plot(seconds, heights, color=CALM, lw=1, transform=axes.get_xaxis_transform())
    axes.set(xlabel="seconds", ylabel=curve_name(document), xlim=(start, start + document.frames / rate))
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    return axes
