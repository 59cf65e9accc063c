"""The places of the markers of a C3D in every frame. What a camera did not see for a moment is filled in."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Shaped

from caesura.core.errors import InvalidModel
from caesura.formats.c3d.number_encodings import Processor
from caesura.formats.c3d.point_data_layout import C3dLayout
from caesura.formats.notices import Notices

LONGEST_GAP = 1.0
"""Seconds for which a marker may be hidden: a straight line stands for what it did. Hidden longer, it is left out."""

SHOWN = 8
FARTHEST = 1e30


@dataclass(frozen=True)
class Markers:
    """Names, and places (frames, markers, 3) in metres, the second axis up."""

    names: list[str]
    places: Float[np.ndarray, "frames markers 3"]


def read_markers(data: memoryview, layout: C3dLayout, notices: Notices) -> Markers:
    """The markers that were seen all the time, but for short gaps.

    Raises `InvalidModel("hidden-markers")` where there is none.
    """
    names = [_name(layout, i) for i in range(layout.points)]
    placed = np.array([name not in layout.unplaced for name in names], bool)
    if not placed.all():
        notices.add("points-ignored", f"{(~placed).sum()} points are angles, forces or the like, and no places.")
    if layout.analog:
        notices.add("analog-ignored", "The analog channels of the C3D are not used.")
    stored = _stored(data, layout)[:, placed]
    names = [name for name, used in zip(names, placed, strict=True) if used]
    places = stored[:, :, :3] * (layout.scale if layout.integers else 1.0)
    seen = (np.abs(places) < FARTHEST).all(axis=2) & (stored[:, :, 3] >= 0)
    places = np.where(seen[:, :, None], places, 0.0) * layout.metres
    return _fill_gaps(names, places @ _screen(layout.axes).T, seen, layout.rate, notices)


def _name(layout: C3dLayout, number: int) -> str:
    label = layout.labels[number] if number < len(layout.labels) else ""
    return label or f"marker {number}"


def _stored(data: memoryview, layout: C3dLayout) -> Float[np.ndarray, "frames points 4"]:
    """All four numbers of every point, as float64."""
    order = ">" if layout.processor == Processor.SGI else "<"
    shape, size = (layout.frames, layout.points, 4), layout.number_bytes
    strides = (layout.stride, 4 * size, size)
    if layout.integers or layout.processor != Processor.DEC:
        kind = f"{order}i2" if layout.integers else f"{order}f4"
        return _widened(np.ndarray(shape, kind, data, layout.start, strides))
    halves = np.ndarray((*shape, 2), "<u2", data, layout.start, (*strides, 2))
    exchanged = np.ascontiguousarray(halves[..., ::-1])
    return _widened(exchanged.view("<f4")[..., 0]) / 4


def _widened(stored: Shaped[np.ndarray, "frames points 4"]) -> Float[np.ndarray, "frames points 4"]:
    return np.nan_to_num(stored.astype(np.float64), nan=np.inf, posinf=np.inf, neginf=-np.inf)


def _screen(axes: tuple[str, str]) -> Float[np.ndarray, "3 3"]:
    """The rotation that makes the axis which points up on the screen the second one; z, where the file says nothing."""
    right, up = (_direction(axis) for axis in axes)
    if right is None or up is None or right @ up:
        right, up = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    return np.stack([right, up, np.cross(right, up)])


def _direction(axis: str) -> Float[np.ndarray, "3"] | None:
    letter, sign = axis[-1:].upper(), -1.0 if axis.startswith("-") else 1.0
    return sign * np.eye(3)["XYZ".index(letter)] if letter and letter in "XYZ" else None


def _fill_gaps(
    names: list[str],
    places: Float[np.ndarray, "frames markers 3"],
    seen: Bool[np.ndarray, "frames markers"],
    rate: float,
    notices: Notices,
) -> Markers:
    """The markers without a gap that is too long, their gaps bridged; before and after all they stand still."""
    kept, gaps, longest = [], 0, 0
    for marker in range(len(names)):
        lengths = _gap_lengths(seen[:, marker])
        if not lengths or (max(lengths) <= LONGEST_GAP * rate and seen[:, marker].any()):
            kept.append(marker)
            gaps, longest = gaps + len(lengths), max([longest, *lengths])
    if not kept:
        raise InvalidModel(
            "hidden-markers",
            f"Each of the {len(names)} markers is hidden for more than {LONGEST_GAP:g} s at a time. Fill the gaps in "
            "the program that captured them.",
        )
    if len(kept) < len(names):
        lost = [name for i, name in enumerate(names) if i not in set(kept)]
        more = f" and {len(lost) - SHOWN} more" if len(lost) > SHOWN else ""
        shown = ", ".join(name[:40] for name in lost[:SHOWN])
        notices.add("markers-left-out", f"Hidden for more than {LONGEST_GAP:g} s and left out: {shown}{more}.")
    if gaps:
        detail = f"{gaps} gaps of markers, the longest of {longest / rate:.2f} s, were filled by straight lines."
        notices.add("gaps-filled", detail)
    filled = places[:, kept]
    frames = np.arange(len(places))
    for column, marker in enumerate(kept):
        here = seen[:, marker]
        if not here.all():
            for axis in range(3):
                filled[:, column, axis] = np.interp(frames, frames[here], filled[here, column, axis])
    return Markers([names[marker] for marker in kept], filled)


def _gap_lengths(seen: Bool[np.ndarray, "frames"]) -> list[int]:
    """How many frames each gap is long."""
    edges = np.flatnonzero(np.diff(np.concatenate([[True], seen, [True]]).astype(np.int8)))
    return [int(length) for length in edges[1::2] - edges[::2]]
