"""The keys of one channel, decoded, with the arithmetic of glTF between them (glTF 2.0, appendix C)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int, Shaped

from caesura.formats.gltf.animation.channels import INTERPOLATIONS
from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.posing.node_graph import unit_rotations

NEAR = 0.9995
"""Cosine from which on a chord, normalised, stands for the arc: as the reader does."""


@dataclass(frozen=True)
class ChannelKeys:
    """`stored` (keys, 1 or 3, width) as in the file: values, or in-tangent, value and out-tangent of a spline."""

    interpolation: str
    is_rotation: bool
    times: Float[np.ndarray, "keys"]
    stored: Shaped[np.ndarray, "keys parts width"]
    decoded: Float[np.ndarray, "keys parts width"]

    @cached_property
    def values(self) -> Float[np.ndarray, "keys width"]:
        """The values alone, float64; rotations of unit length, but those of a spline, which is normalised after."""
        return np.ascontiguousarray(self.rows[:, 1 if self.is_spline else 0])

    @cached_property
    def rows(self) -> Float[np.ndarray, "keys parts width"]:
        """Values and tangents, float64."""
        return np.asarray(self.decoded, np.float64)

    @property
    def is_spline(self) -> bool:
        """Whether keys have tangents, in units per second."""
        return self.interpolation == "CUBICSPLINE"

    def at(self, seconds: Float[np.ndarray, "some"]) -> Float[np.ndarray, "some width"]:
        """Values at some times, held before the first key and after the last one."""
        key, following, share = self._between(seconds)
        before: Float[np.ndarray, "some width"] = self.values[key]
        if self.interpolation == "STEP":
            return before
        if self.is_spline:
            values = self.spline(seconds)[:, 1]
            return _unit(values) if self.is_rotation else values
        if self.is_rotation:
            return quaternion_arc(before, self.values[following], share)
        mixed: Float[np.ndarray, "some width"] = before + share * (self.values[following] - before)
        return mixed

    def spline(self, seconds: Float[np.ndarray, "some"]) -> Float[np.ndarray, "some 3 width"]:
        """Keys of a spline at some times, such that the spline through them is the same one.

        A part of a cubic is the cubic with its ends' values and derivatives; in glTF both tangents are derivatives
        by the second, so they need no other scale. Outside the keys all stands still.
        """
        key, following, s = self._between(seconds)
        step = np.maximum(self.times[following] - self.times[key], 1e-12)[:, None]
        a, m = self.rows[key, 1], self.rows[key, 2] * step
        b, n = self.rows[following, 1], self.rows[following, 0] * step
        value = (
            (2 * s**3 - 3 * s**2 + 1) * a + (s**3 - 2 * s**2 + s) * m + (3 * s**2 - 2 * s**3) * b + (s**3 - s**2) * n
        )
        slope = ((6 * s**2 - 6 * s) * (a - b) + (3 * s**2 - 4 * s + 1) * m + (3 * s**2 - 2 * s) * n) / step
        inside = (seconds >= self.times[0]) & (seconds <= self.times[-1]) & (key != following)
        slope = np.where(inside[:, None], slope, 0.0)
        return np.stack([slope, value, slope], axis=1)

    def _between(
        self, seconds: Float[np.ndarray, "some"]
    ) -> tuple[Int[np.ndarray, "some"], Int[np.ndarray, "some"], Float[np.ndarray, "some 1"]]:
        """The key before, the key after, and how far between them each time is, 0 to 1."""
        last = len(self.times) - 1
        key = np.clip(np.searchsorted(self.times, seconds, "right") - 1, 0, last)
        following = np.minimum(key + 1, last)
        step = self.times[following] - self.times[key]
        share = np.where(step > 0, (seconds - self.times[key]) / np.where(step > 0, step, 1.0), 0.0)
        return key, following, np.clip(share, 0.0, 1.0)[:, None]


def read_keys(accessors: Accessors, sampler: JsonObject, is_rotation: bool) -> ChannelKeys:
    """The keys of a sampler; raises `invalid-animation` where their numbers do not fit together."""
    interpolation = sampler.choice("interpolation", INTERPOLATIONS, "LINEAR")
    times = accessors.floats(key_layout(accessors, sampler, "input")).reshape(-1).astype(np.float64)
    layout = key_layout(accessors, sampler, "output")
    parts = 3 if interpolation == "CUBICSPLINE" else 1
    width, rest = divmod(layout.count * layout.width, max(len(times), 1) * parts)
    if rest or not width or (np.diff(times) < 0).any():
        raise sampler.refusal("Its keys and its values do not fit together.", "invalid-animation")
    decoded = accessors.floats(layout).reshape(-1, parts, width)
    if is_rotation and parts == 1 and width == 4:
        decoded = unit_rotations(decoded[:, 0], rounded=layout.dtype.kind != "f")[:, None]
    stored = accessors.elements(layout).reshape(-1, parts, width)
    return ChannelKeys(interpolation, is_rotation and width == 4, times, stored, decoded)


def key_layout(accessors: Accessors, sampler: JsonObject, name: str) -> AccessorLayout:
    """What the accessor of a sampler's `input` or `output` says it is."""
    return accessors.layout(sampler.index(name, len(accessors), "accessors", "invalid-animation"))


def quaternion_arc(
    a: Float[np.ndarray, "some 4"], b: Float[np.ndarray, "some 4"], share: Float[np.ndarray, "some 1"]
) -> Float[np.ndarray, "some 4"]:
    """Rotations along the shorter arc from a to b: slerp."""
    cosine = np.sum(a * b, axis=1, keepdims=True)
    b = np.where(cosine < 0, -b, b)
    angle = np.arccos(np.clip(np.abs(cosine), -1, 1))
    sine = np.where(np.abs(cosine) >= NEAR, 1.0, np.sin(angle))
    u = np.where(np.abs(cosine) >= NEAR, 1 - share, np.sin((1 - share) * angle) / sine)
    v = np.where(np.abs(cosine) >= NEAR, share, np.sin(share * angle) / sine)
    turned = np.where(np.abs(cosine) >= NEAR, _unit(u * a + v * b), u * a + v * b)
    same: Float[np.ndarray, "some 4"] = np.where((a == b).all(axis=1, keepdims=True), a, turned)
    return same


def _unit(q: Float[np.ndarray, "some 4"]) -> Float[np.ndarray, "some 4"]:
    length = np.linalg.norm(q, axis=1, keepdims=True)
    still = np.array([0.0, 0.0, 0.0, 1.0])
    unit: Float[np.ndarray, "some 4"] = np.where(length > 0, q / np.where(length > 0, length, 1.0), still)
    return unit
