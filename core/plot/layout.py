"""The layout of the picture of a result. Light: no NumPy, so that the web process can draw it."""

import math
import unicodedata
from collections.abc import Iterable, Iterator
from itertools import groupby

from caesura.core.plot.picture import TEXT, Box, Dot, Label, Line, Picture, Point
from caesura.core.segmentation_document import Segment, SegmentationDocument, motion_name

LEFT, TOP, WIDTH, CURVE, GAP, BAR, BELOW, RIGHT = 64, 14, 880, 200, 8, 28, 44, 16
INK, FAINT, DISCARDED, KEY, CALM = "#222222", "#9a9a9a", "#dddddd", "#c1121f", "#2f6fb0"
VARIANCE = 0.3
"""Share of the plot's height that a curve of variances fills."""
COLOURS = (
    "#4a85ee", "#e36927", "#176c5f", "#fadb86", "#a860af", "#b1c426",
    "#9deef9", "#b23308", "#8a9784", "#f0acad", "#6a40b0", "#8fb8fe",
)  # fmt: skip
"""Of motions, as in the page: they stay apart for every kind of colour vision."""

CURVE_TICKS, TIME_TICKS = 5, 12
MINUTES_FROM = 180.0
"""Seconds of a take from which the axis counts minutes."""


def lay_out_picture(document: SegmentationDocument) -> Picture:
    """The curve over the segments, as the paper's figures 4 and 5."""
    found = f"{len(document.segments)} segments of {document.motions} motions, {len(document.key_frames)} key-frames"
    return Picture(
        LEFT + WIDTH + RIGHT,
        TOP + CURVE + GAP + BAR + BELOW,
        f"Energy curve: {found}",
        (*_energy(document), *_variances(document), *_segments(document), *_clock(document)),
    )


def _energy(document: SegmentationDocument) -> Iterator[Box | Line | Dot | Label]:
    values = [value for value in document.energy if value is not None]
    low, high = min(values, default=0.0), max(values, default=1.0)
    margin = 0.06 * (high - low) or 0.5
    low, high = low - margin, high + margin

    def place(frame: int, energy: float) -> Point:
        return _x(document, frame), TOP + CURVE * (high - energy) / (high - low)

    for tick in _ticks(low, high, CURVE_TICKS):
        y = place(0, tick)[1]
        yield Line(((LEFT - 4, y), (LEFT, y)), INK)
        yield Label((LEFT - 8, y + TEXT / 3), f"{tick:g}", INK, "end")
    yield Label((16, TOP + CURVE / 2), curve_name(document), INK, upright=True)
    for segment in document.segments[1:]:
        x = _x(document, segment.start)
        yield Line(((x, TOP), (x, TOP + CURVE + GAP)), FAINT, dashed=True)
    for run in _curve_runs(document):
        yield Line(tuple(place(*point) for point in _thin_out(document, run)), INK, 1.5)
    for key in document.key_frames:
        yield Dot(place(key.frame, key.energy), 3.5, KEY)
    yield Line(((LEFT, TOP), (LEFT, TOP + CURVE), (LEFT + WIDTH, TOP + CURVE)), INK)


def curve_name(document: SegmentationDocument) -> str:
    """What the curve is, and its unit."""
    return "distance of frames" if document.parameters.get("energy") == "distance" else "energy (nats)"


def _variances(document: SegmentationDocument) -> Iterator[Line]:
    """Each curve of Eq. 5 in the lowest part of the plot, by itself from its least to its largest value."""
    for curve in document.variances:
        low, high = min(curve.values), max(curve.values)
        points = [
            (_x(document, curve.start + i), TOP + CURVE * (1 - VARIANCE * (value - low) / ((high - low) or 1.0)))
            for i, value in enumerate(curve.values)
        ]
        yield Line(tuple(points), CALM, 1.2)


def _curve_runs(document: SegmentationDocument) -> Iterator[list[tuple[int, float]]]:
    """Frames and energies where the curve does not break off."""
    for known, run in groupby(enumerate(document.energy), lambda point: point[1] is not None):
        if known:
            yield [(frame, energy) for frame, energy in run if energy is not None]


def _thin_out(document: SegmentationDocument, run: list[tuple[int, float]]) -> Iterator[tuple[int, float]]:
    """Of all frames in one column of pixels the first, the lowest, the highest and the last: it looks the same."""
    for _, column in groupby(run, lambda point: int(_x(document, point[0]))):
        points = list(column)
        extremes = (min(points, key=lambda p: p[1]), max(points, key=lambda p: p[1]))
        yield from sorted({points[0], *extremes, points[-1]})


def _segments(document: SegmentationDocument) -> Iterator[Box | Label]:
    y = TOP + CURVE + GAP
    for segment in document.segments:
        left, right = _x(document, segment.start), _x(document, segment.end)
        fill = DISCARDED if segment.discard else COLOURS[segment.motion % len(COLOURS)]
        yield Box(left, y, right - left, BAR, fill)
        if _text_width(segment.name) <= right - left - 6:
            yield _visible_name(segment, (left + right) / 2, y + BAR / 2 + TEXT / 3, _ink_on(fill))


def _visible_name(segment: Segment, x: float, y: float, ink: str) -> Label:
    return Label((x, y), segment.name, ink, spare=motion_name(segment.motion))


def _clock(document: SegmentationDocument) -> Iterator[Line | Label]:
    y, first = TOP + CURVE + GAP + BAR, document.source.start_seconds
    seconds = document.frames / document.frame_rate
    minutes = first + seconds > MINUTES_FROM
    unit = 60.0 if minutes else 1.0
    for tick in _ticks(first / unit, (first + seconds) / unit, TIME_TICKS):
        x = LEFT + WIDTH * (tick * unit - first) / seconds
        yield Line(((x, y), (x, y + 4)), INK)
        yield Label((x, y + 6 + TEXT), f"{tick:.10g}", INK)
    yield Label((LEFT + WIDTH / 2, y + 10 + 2 * TEXT), "minutes" if minutes else "seconds", INK)


def _x(document: SegmentationDocument, frame: int) -> float:
    return LEFT + WIDTH * frame / document.frames


def _ticks(low: float, high: float, most: int) -> Iterable[float]:
    """Round numbers within [low, high], at most so many and one."""
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * factor for factor in (1, 2, 5, 10) if power * factor >= rough)
    return [number * step for number in range(math.ceil(low / step), math.floor(high / step) + 1)]


def _text_width(text: str) -> float:
    """About so many pixels: a letter is six tenths of its height wide, an ideograph as wide as it is high."""
    return sum(TEXT * (1.0 if unicodedata.east_asian_width(letter) in "WF" else 0.6) for letter in text)


def _ink_on(fill: str) -> str:
    """Dark or white, whichever is read more easily (WCAG's relative luminance)."""
    shares = [int(fill[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in shares)
    return "#14161a" if 0.2126 * red + 0.7152 * green + 0.0722 * blue > 0.179 else "#ffffff"
