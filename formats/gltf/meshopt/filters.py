"""What is undone after an attribute codec (KHR_meshopt_compression, appendix B): from short codes to numbers."""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float32, Int, UInt8

Elements = UInt8[np.ndarray, "count stride"]


def octahedral(raw: Elements) -> Elements:
    """Unit vectors folded onto a square; the third number of each says what 1 is."""
    coded, largest = _components(raw)
    one = coded[:, 2]
    x, y = coded[:, 0] / one, coded[:, 1] / one
    z = 1 - np.abs(x) - np.abs(y)
    below = np.minimum(z, np.float32(0))
    x, y = x - np.copysign(below, x), y - np.copysign(below, y)
    unit = np.stack([x, y, z], axis=1) / np.sqrt(x * x + y * y + z * z)[:, None]
    return _stored(np.concatenate([unit * largest, coded[:, 3:]], axis=1), raw)


def quaternion(raw: Elements) -> Elements:
    """Rotations without their largest number, which is positive; the fourth says what 1 is and which one is missing."""
    whole = raw.view("<i2").astype(np.int64)
    coded = whole[:, :3].astype(np.float32) / (whole[:, 3:] | 3).astype(np.float32) * np.float32(np.sqrt(0.5))
    largest = np.sqrt(np.maximum(0, 1 - np.sum(coded * coded, axis=1, keepdims=True)))
    turned = np.empty((len(raw), 4), np.float32)
    places = ((whole[:, 3:] & 3) + np.arange(4)) % 4
    np.put_along_axis(turned, places, np.concatenate([largest, coded], axis=1), axis=1)
    return _stored(turned * np.float32(32767), raw)


def exponential(raw: Elements) -> Elements:
    """Numbers of 24 signed bits times a power of two of 8."""
    word = raw.view("<i4")
    value: Float32[np.ndarray, "count numbers"] = np.ldexp(((word << 8) >> 8).astype(np.float32), word >> 24)
    return value.astype("<f4").view(np.uint8)


def colour(raw: Elements) -> Elements:
    """Colours, which change no vertex, are never read: they stay as they are."""
    return raw


FILTERS: dict[str, tuple[Callable[[Elements], Elements] | None, tuple[int, ...]]] = {
    "NONE": (None, ()),
    "OCTAHEDRAL": (octahedral, (4, 8)),
    "QUATERNION": (quaternion, (8,)),
    "EXPONENTIAL": (exponential, ()),
    "COLOR": (colour, (4, 8)),
}
"""By name: what undoes it, and the bytes its elements may have; any where none are named."""


def _components(raw: Elements) -> tuple[Float32[np.ndarray, "count 4"], np.float32]:
    kind: str = "<i2" if raw.shape[1] == 8 else "i1"
    return raw.view(kind).astype(np.float32), np.float32(np.iinfo(kind).max)


def _stored(values: Float32[np.ndarray, "count 4"], raw: Elements) -> Elements:
    """Rounded to whole numbers, halves away from zero; what has no value, as zeros of a broken file, is 0."""
    whole: Int[np.ndarray, "count 4"] = np.nan_to_num(np.trunc(values + np.copysign(np.float32(0.5), values))).astype(
        int
    )
    kind: str = "<i2" if raw.shape[1] == 8 else "i1"
    return whole.astype(kind).view(np.uint8)
