"""The keys of an F-curve between two frames, so that the curve there is the same.

A Bézier curve that is cut between two keys is split after de Casteljau: the value and both handles at the cut are
those of the whole curve.
"""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

CONSTANT, LINEAR, BEZIER = 0, 1, 2
"""Interpolations by Blender's numbers; larger ones are easings."""

FREE = 0
"""The handle type that nothing moves."""

HALVINGS = 50
SLACK = 1e-6


@dataclass
class Keys:
    """Keys by frame: places and handles (n, 2) as (frame, value), and Blender's numbers for the rest, (n,)."""

    co: Any
    left: Any
    right: Any
    interpolation: Any
    left_type: Any
    right_type: Any

    def __len__(self) -> int:
        return len(self.co)

    def part(self, first: int, last: int) -> "Keys":
        """A copy of keys [first, last)."""
        return Keys(*(getattr(self, field.name)[first:last].copy() for field in fields(self)))


def cut_keys(keys: Keys, start: float, end: float) -> Keys | None:
    """The keys of frames [start, end], both included, moved to begin at 0.

    Before its first key and after its last the curve is held. None where no keys are the same curve: where an easing
    would have to be split, or handles so long that Blender would shorten those of the part. Evaluate it instead.
    """
    frames = keys.co[:, 0]
    first, last = int(np.searchsorted(frames, start)), int(np.searchsorted(frames, end, side="right"))
    before, after = first - 1, last - 1
    split_start = 0 <= before < len(keys) - 1 and (first == len(keys) or frames[first] > start)
    split_end = after >= 0 and after < len(keys) - 1 and frames[after] < end
    if any(
        keys.interpolation[at] > BEZIER for at in ([before] if split_start else []) + ([after] if split_end else [])
    ):
        return None
    part = keys.part(before if split_start else first, last + 1 if split_end else last)
    if not len(part):
        part = keys.part(0, 1) if first == 0 else keys.part(len(keys) - 1, len(keys))
        part.co[:, 0] = start
    if split_end and not _split(part, len(part) - 2, end, keep_before=True):
        return None
    if split_start and not _split(part, 0, start, keep_before=False):
        return None
    _fix_border_handles(part)
    for places in (part.co, part.left, part.right):
        places[:, 0] -= start
    return part


def baked_keys(values: Any) -> Keys:
    """A straight key on every frame from 0."""
    co = np.stack([np.arange(len(values), dtype=np.float64), np.asarray(values, np.float64)], axis=1)
    whole = np.ones(len(values), np.int32)
    return Keys(co, co.copy(), co.copy(), whole * LINEAR, whole * FREE, whole * FREE)


def _split(part: Keys, at: int, frame: float, *, keep_before: bool) -> bool:
    """Put the key after `at`, or the key `at` itself, on `frame` between the two; whether its handles fit there."""
    moved = at + 1 if keep_before else at
    kind = int(part.interpolation[at])
    if kind == BEZIER:
        a, b = part.co[at], part.co[at + 1]
        points = np.stack([a, *_usable_handles(a, part.right[at], part.left[at + 1], b), b])
        before, after = _de_casteljau(points, _share_at(points[:, 0], frame))
        kept = before if keep_before else after
        if min(kept[1:3, 0]) < kept[0, 0] - SLACK or max(kept[1:3, 0]) > kept[3, 0] + SLACK:
            return False
        if keep_before:
            part.right[at], part.left[moved], part.co[moved] = before[1], before[2], before[3]
            part.right[moved] = before[3]
        else:
            part.co[moved], part.right[moved], part.left[at + 1] = after[0], after[1], after[2]
            part.left[moved] = after[0]
    else:
        share = (frame - part.co[at, 0]) / (part.co[at + 1, 0] - part.co[at, 0])
        value = part.co[at, 1] if kind == CONSTANT else (1 - share) * part.co[at, 1] + share * part.co[at + 1, 1]
        part.co[moved] = part.left[moved] = part.right[moved] = (frame, value)
    return True


def _usable_handles(a: Any, right: Any, left: Any, b: Any) -> tuple[Any, Any]:
    """Handles as Blender evaluates them: none reaches further than the other key."""
    length = b[0] - a[0]
    shares = [min(1.0, length / max(abs(reach), 1e-30)) for reach in (right[0] - a[0], b[0] - left[0])]
    return a + shares[0] * (right - a), b + shares[1] * (left - b)


def _share_at(frames: Any, frame: float) -> float:
    """Where along a Bézier curve of growing frames one frame is."""
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        s = 1 - middle
        weights = np.array([s**3, 3 * s * s * middle, 3 * s * middle**2, middle**3])
        low, high = (middle, high) if float(weights @ frames) < frame else (low, middle)
    return (low + high) / 2


def _de_casteljau(points: Any, share: float) -> tuple[Any, Any]:
    """The control points (4, 2) of a cubic curve before and after a share of it."""
    before, after = [points[0]], [points[-1]]
    while len(points) > 1:
        points = (1 - share) * points[:-1] + share * points[1:]
        before.append(points[0])
        after.append(points[-1])
    return np.stack(before), np.stack(after[::-1])


def _fix_border_handles(part: Keys) -> None:
    """Automatic handles follow the keys beside them: where one of these is gone, they are to stay as they were."""
    for at in {0, 1, len(part) - 2, len(part) - 1} & set(range(len(part))):
        part.left_type[at] = part.right_type[at] = FREE
