"""How PC2 and MDD lay out their numbers: what stands before the places, checked. Light: no NumPy.

PC2 (little-endian): the letters POINTCACHE2 and a zero, a version, the number of points, the first frame, how many
frames each sample takes, and the number of samples. MDD (big-endian): the numbers of samples and points, and the
second of each sample. Then both have three float32 a point, sample by sample.
"""

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass

from caesura.core.errors import BrokenContainer
from caesura.core.limits import Limits
from caesura.formats.takes.frame_rate import ASSUMED, snap_frame_rate

PC2_MAGIC = b"POINTCACHE2\0"
PC2_HEAD = struct.Struct("<12siiffi")
MDD_HEAD = struct.Struct(">ii")
POINT_BYTES = 12


@dataclass(frozen=True)
class PointCacheLayout:
    """`samples` of `points` each begin at byte `start`, float32 in the byte order `order`."""

    samples: int
    points: int
    start: int
    order: str
    frames_per_sample: float = 1.0


def read_pc2_layout(head: bytes, size: int, limits: Limits) -> PointCacheLayout:
    """That of a PC2 of `size` bytes that begins with `head`.

    Raises `BrokenContainer("malformed-pc2")` or `LimitExceeded`.
    """
    if len(head) < PC2_HEAD.size:
        raise malformed_cache("pc2", "ends within its head")
    _, version, points, _, step, samples = PC2_HEAD.unpack_from(head)
    if version != 1:
        raise malformed_cache("pc2", f"is of version {version}; 1 is read")
    if not 0 < step <= 1e6:
        raise malformed_cache("pc2", f"takes a sample every {step:g} frames")
    return _checked("pc2", PointCacheLayout(samples, points, PC2_HEAD.size, "<", step), size, limits)


def read_mdd_layout(head: bytes, size: int, limits: Limits) -> PointCacheLayout:
    """That of an MDD of `size` bytes that begins with `head`.

    Raises `BrokenContainer("malformed-mdd")` or `LimitExceeded`.
    """
    samples, points = MDD_HEAD.unpack_from(head)
    return _checked("mdd", PointCacheLayout(samples, points, MDD_HEAD.size + 4 * samples, ">"), size, limits)


def read_mdd_seconds(data: memoryview, layout: PointCacheLayout) -> tuple[float, ...]:
    """The times of the samples of an MDD."""
    return struct.unpack_from(f">{layout.samples}f", data, MDD_HEAD.size)


def mean_rate(first: float, last: float, samples: int) -> float | None:
    """Samples per second between two times, the known rate that is near it; None where the times do not tell."""
    span = last - first
    if samples < 2 or not math.isfinite(span) or span <= 0:
        return None
    rate = (samples - 1) / span
    return snap_frame_rate(rate) or (rate if 1e-6 <= rate <= 1e6 else None)


def rate_of_step(layout: PointCacheLayout) -> float:
    """Samples per second of a PC2, whose frames have no rate: it is assumed."""
    return ASSUMED / layout.frames_per_sample


def malformed_cache(kind: str, what: str, **where: int) -> BrokenContainer:
    """The refusal of a point cache."""
    return BrokenContainer(f"malformed-{kind}", f"The {kind.upper()} {what}. Export it again.", **where)


def is_even(seconds: Sequence[float], rate: float) -> bool:
    """Whether every time is within half a frame of its place at `rate`."""
    return all(abs((second - seconds[0]) * rate - place) <= 0.5 for place, second in enumerate(seconds))


def _checked(kind: str, layout: PointCacheLayout, size: int, limits: Limits) -> PointCacheLayout:
    if layout.samples <= 0 or layout.points <= 0:
        raise malformed_cache(kind, f"has {layout.samples} samples of {layout.points} points")
    limits.check("max_vertices", layout.points)
    limits.check("max_frames", layout.samples, "Cut the take")
    needed = layout.start + layout.samples * layout.points * POINT_BYTES
    if size < needed:
        raise malformed_cache(
            kind, f"has {size:,} bytes; {layout.samples:,} samples of {layout.points:,} points need {needed:,}"
        )
    return layout
