"""Blend shapes: a channel has one weight and one shape or several, each for a weight of its own."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from caesura.core.limits import Limits
from caesura.formats.native.fbx.held_objects import all_held, held, numbers, whole_numbers
from caesura.formats.native.finite_numbers import finite_float32


@dataclass(frozen=True)
class BlendChannel:
    """A channel of the library. `stops` are the weights at which its shapes are there alone, not decreasing."""

    channel: Any
    stops: Float[np.ndarray, "shapes"]

    def shares(self, weights: Float[np.ndarray, "frames"]) -> Float[np.ndarray, "frames shapes"]:
        """How much of each shape there is at a weight.

        At a stop its shape is there alone, at 0 none; between two neighbours both are blended. Beyond the outermost
        ones the last stretch goes on: a shape may outweigh itself, and the one before it be taken off.
        """
        zero = int(np.searchsorted(self.stops, 0.0))
        knots = np.insert(self.stops, zero, 0.0)
        upper = np.clip(np.searchsorted(knots, weights, side="right"), 1, len(knots) - 1)
        width = knots[upper] - knots[upper - 1]
        share = np.divide(weights - knots[upper - 1], width, out=np.zeros(len(weights)), where=width > 0)
        shares = np.zeros((len(weights), len(knots)))
        frames = np.arange(len(weights))
        shares[frames, upper] = share
        shares[frames, upper - 1] = 1 - share
        return np.delete(shares, zero, axis=1)


@dataclass(frozen=True)
class BlendShapes:
    """The channels of a mesh, and the displacements of their shapes, in order."""

    channels: list[BlendChannel]
    offsets: list[tuple[Int[np.ndarray, "_"], Float[np.ndarray, "_ 3"]]]

    def targets(self, source: Int[np.ndarray, "V"], vertices: int) -> list[Float[np.ndarray, "V 3"]]:
        """The displacement of every vertex, of which `source` is the control point."""
        found = []
        for points, displacements in self.offsets:
            dense = np.zeros((vertices, 3), np.float32)
            inside = (points >= 0) & (points < vertices)
            dense[points[inside]] = displacements[inside]
            found.append(dense[source])
        return found

    def rest_shares(self) -> list[float]:
        """How much of each shape there is where nothing is animated."""
        found = [one.shares(np.array([float(one.channel.weight)]))[0] for one in self.channels]
        return finite_float32(np.concatenate(found), "A blend shape").tolist() if found else []


def read_blend_shapes(mesh: Any, limits: Limits) -> BlendShapes:
    """Those of all its deformers, which add up."""
    channels: list[BlendChannel] = []
    offsets: list[tuple[Int[np.ndarray, "_"], Float[np.ndarray, "_ 3"]]] = []
    for deformer in all_held(mesh.blend_deformers):
        for channel in all_held(deformer.channels):
            keys = sorted(all_held(channel.keyframes), key=lambda key: float(key.target_weight))
            channels.append(BlendChannel(channel, np.array([float(key.target_weight) for key in keys])))
            limits.check("max_targets", len(offsets) + len(keys))
            limits.check("max_target_vertices", (len(offsets) + len(keys)) * mesh.num_vertices)
            offsets += [_offsets(held(key.shape)) for key in keys]
    return BlendShapes(channels, offsets)


def _offsets(shape: Any) -> tuple[Int[np.ndarray, "_"], Float[np.ndarray, "_ 3"]]:
    """The control points that a shape moves, and how far: some files weight each of them."""
    points, moved = whole_numbers(shape.offset_vertices), numbers(shape.position_offsets).reshape(-1, 3)
    weights = numbers(shape.offset_weights)
    weighted = moved * weights[:, None] if len(weights) == len(moved) else moved
    return points[: len(moved)], finite_float32(weighted, f"The shape {shape.name[:80]!r}")[: len(points)]
