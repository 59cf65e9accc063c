"""Draws how time grows: a log-log plot as SVG, one line a series."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from benchmarks.reports.drawing import COLOURS, INK

WIDTH, HEIGHT, MARGIN = 640, 400, 70  # pixels


class Series(NamedTuple):
    """A name, and (triangle-frames, seconds) of each measurement."""

    name: str
    points: Sequence[tuple[float, float]]


def drawn(series: Sequence[Series]) -> str:
    """The plot, on white: triangle-frames to the right, seconds upwards, a tenfold step every gridline."""
    every = np.log10([point for one in series for point in one.points])
    low, high = np.floor(every.min(axis=0)), np.ceil(every.max(axis=0))

    def place(point: tuple[float, float]) -> tuple[float, float]:
        x, y = (np.log10(point) - low) / (high - low)
        return MARGIN + x * (WIDTH - 2 * MARGIN), HEIGHT - MARGIN - y * (HEIGHT - 2 * MARGIN)

    look = f'font-family="sans-serif" font-size="13" fill="{INK}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" {look}>',
        '<rect width="100%" height="100%" fill="white"/>',
    ]
    for exponent in np.arange(low[0], high[0] + 1):
        x, y = place((10.0**exponent, 10.0 ** low[1]))
        parts.append(f'<path d="M{x:.1f} {MARGIN}V{y:.1f}" stroke="#dddddd"/>{_text(x, y + 20, f"1e{exponent:.0f}")}')
    for exponent in np.arange(low[1], high[1] + 1):
        x, y = place((10.0 ** low[0], 10.0**exponent))
        words = _text(x - 26, y + 5, f"{10.0**exponent:g} s")
        parts.append(f'<path d="M{x:.1f} {y:.1f}H{WIDTH - MARGIN}" stroke="#dddddd"/>{words}')
    parts.append(_text(WIDTH / 2, HEIGHT - 20, "triangle-frames"))
    for number, one in enumerate(series):
        colour = COLOURS[number % len(COLOURS)]
        dots = [place(point) for point in one.points]
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in dots)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>' for x, y in dots]
        parts.append(f'<text x="{MARGIN + 12}" y="{MARGIN + 18 * number}" fill="{colour}">{one.name}</text>')
    return "\n".join([*parts, "</svg>\n"])


def _text(x: float, y: float, words: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="middle">{words}</text>'
