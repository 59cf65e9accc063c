"""Figures 1 and 8 as curves, 3 and 5 as the plot of a result with its variances, 4 and 6 as bars."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from caesura.core.energy.energy_curve import compute_energy_curve
from caesura.core.plot.picture import Label, Line, Picture
from caesura.core.plot.svg import render_svg

WIDTH, HEIGHT, LEFT, TOP = 880, 150, 150, 12
COLOURS = ("#2f6fb0", "#c1121f", "#176c5f")
TRIANGLES, FRAMES, WINDOW, LEVELS = 1000, 120, 12, 10


def curves_picture(title: str, curves: Sequence[tuple[str, Float[np.ndarray, "frames"]]]) -> str:
    """Each curve in a panel of its own, from its least to its largest value, which are written beside it."""
    shapes: list[Line | Label] = []
    for number, (name, values) in enumerate(curves):
        top, known = TOP + number * (HEIGHT + 30), np.flatnonzero(np.isfinite(values))
        low, high = float(values[known].min()), float(values[known].max())
        scale = (high - low) if high - low > 1e-9 * max(abs(high), 1) else 1.0
        points = [
            (LEFT + WIDTH * int(frame) / (len(values) - 1), top + HEIGHT * (1 - (float(values[frame]) - low) / scale))
            for frame in known
        ]
        shapes += [
            Line(((LEFT, top), (LEFT, top + HEIGHT), (LEFT + WIDTH, top + HEIGHT)), "#222222"),
            Line(tuple(points), COLOURS[number % len(COLOURS)], 1.5),
            Label((LEFT - 8, top + 12), f"{high:.3g}", "#222222", "end"),
            Label((LEFT - 8, top + HEIGHT), f"{low:.3g}", "#222222", "end"),
            Label((LEFT - 8, top + HEIGHT / 2), name, "#222222", "end"),
        ]
    return render_svg(Picture(LEFT + WIDTH + 20, TOP + len(curves) * (HEIGHT + 30), title, tuple(shapes)))


def opposite_strains() -> tuple[Float[np.ndarray, "frames"], Float[np.ndarray, "frames"]]:
    """Figure 8: half of the triangles go from strain .35 to .55, half the other way; the energy and the sum of strains.

    Each triangle's own strain lies within .05 of its group's.
    """
    share = np.clip((np.arange(FRAMES) - FRAMES / 4) / (FRAMES / 2), 0, 1)[:, None]
    apart = np.linspace(-0.05, 0.05, TRIANGLES // 2, endpoint=False)
    rising, falling = 0.35 + 0.2 * share + apart, 0.55 - 0.2 * share + apart
    strains = np.concatenate([rising, falling], axis=1)
    bins = np.clip(np.ceil(strains * LEVELS - 1e-9).astype(int) - 1, 0, LEVELS - 1).astype(np.uint8)
    return compute_energy_curve([np.ascontiguousarray(bins.T)], FRAMES, WINDOW, LEVELS), strains.sum(axis=1)
