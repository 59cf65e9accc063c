"""Draws a segmentation over its truth, as the paper's figure 5 does: an SVG of the curve, its key-frames and cuts."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from jaxtyping import Int

from benchmarks.takes.cmu import Annotation
from caesura.core.agreement import cut_frames
from caesura.core.segmentation import Segmentation

WIDTH, CURVE, BAR, GAP, LEFT = 960, 170, 26, 10, 70  # pixels
COLOURS = ("#4477aa", "#ccbb44", "#ee6677", "#228833", "#66ccee", "#aa3377", "#bbbbbb")
"""Tol's bright scheme, colour-blind safe."""
INK = "#222222"
LEFT_OF_BARS = 40  # pixels more for names of methods


def drawn(found: Segmentation, truth: Annotation) -> str:
    """The picture, on white; the colours of the found motions are those of the true motions they cover most."""
    frames = len(found.labels)
    starts = [0, *found.cuts.tolist(), frames]
    covered = [int(np.bincount(truth.frames[a:b]).argmax()) for a, b in pairwise(starts)]
    names = [label.replace("_", " ") for label in truth.labels]
    height = CURVE + 2 * (BAR + GAP) + 34
    size = f"0 0 {LEFT + WIDTH + 20} {height}"
    look = f'font-family="sans-serif" font-size="13" fill="{INK}"'
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{size}" {look}>',
            '<rect width="100%" height="100%" fill="white"/>',
            *_curve(found, frames),
            *_bar("truth", CURVE + GAP, [0, *truth.ends], truth.order, names, frames),
            *_bar("found", CURVE + BAR + 2 * GAP, starts, covered, [], frames),
            *[_text(_x(f, frames), height - 8, str(f), "middle") for f in range(0, frames, 200)],
            "</svg>\n",
        ]
    )


Labels = Int[np.ndarray, "frames"]


def bars(labelled: Sequence[tuple[str, str, Labels, Labels]]) -> str:
    """As the paper's figure 6: under each take's truth a bar for each method. Take, method, truth and labels.

    The colours of found motions are those of the true motions they cover most.
    """
    parts: list[str] = []
    y = GAP
    for take in dict.fromkeys(row[0] for row in labelled):
        of_take = [row for row in labelled if row[0] == take]
        truth = of_take[0][2]
        parts.append(_text(LEFT_OF_BARS, y + 13, take, "start"))
        y += 18
        for name, labels in (("truth", truth), *((row[1], row[3]) for row in of_take)):
            bounds = [0, *cut_frames(labels).tolist(), len(labels)]
            shown = {m: int(np.bincount(truth[labels == m]).argmax()) for m in np.unique(labels).tolist()}
            motions = [shown[int(labels[a])] for a in bounds[:-1]]
            parts += [f'<g transform="translate({LEFT_OF_BARS} 0)">', *_bar(name, y, bounds, motions, [], len(truth))]
            parts.append("</g>")
            y += BAR + 3
        y += GAP
    size = f"0 0 {LEFT_OF_BARS + LEFT + WIDTH + 20} {y}"
    look = f'font-family="sans-serif" font-size="13" fill="{INK}"'
    head = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{size}" {look}>']
    return "\n".join([*head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>\n"])


def _curve(found: Segmentation, frames: int) -> list[str]:
    top = np.nanmax(found.energy)
    known = np.flatnonzero(np.isfinite(found.energy))
    y = CURVE - (CURVE - 20) * found.energy / top
    points = " ".join(f"{_x(f, frames):.1f},{y[f]:.1f}" for f in known.tolist())
    foot = CURVE + 2 * (BAR + GAP)
    cuts = [
        f'<path d="M{_x(c, frames):.1f} 12V{foot}" stroke="{INK}" stroke-dasharray="4 3"/>' for c in found.cuts.tolist()
    ]
    keys = [
        f'<circle cx="{_x(k, frames):.1f}" cy="{y[k]:.1f}" r="4" fill="white" stroke="{INK}" stroke-width="1.5"/>'
        for k in found.key_frames.tolist()
    ]
    line = f'<polyline points="{points}" fill="none" stroke="{COLOURS[0]}" stroke-width="1.6"/>'
    return [_text(LEFT - 8, CURVE / 2, "energy", "end"), *cuts, line, *keys]


def _bar(
    name: str, y: float, bounds: Sequence[int], motions: Sequence[int], names: Sequence[str], frames: int
) -> list[str]:
    parts = [_text(LEFT - 8, y + BAR - 8, name, "end")]
    for (start, end), motion in zip(pairwise(bounds), motions, strict=True):
        x, width = _x(start, frames), _x(end, frames) - _x(start, frames)
        fill = COLOURS[motion % len(COLOURS)]
        parts.append(f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="{BAR}" fill="{fill}"/>')
    middles = [_x((start + end) / 2, frames) for start, end in pairwise(bounds)]
    return parts + [_text(x, y + BAR - 8, label, "middle") for x, label in zip(middles, names, strict=False)]


def _text(x: float, y: float, words: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'


def _x(frame: float, frames: int) -> float:
    return LEFT + WIDTH * frame / frames
