"""Strain: how much each triangle is stretched or squeezed in its own plane, against the rest shape (paper, section 3).

Rigid motion cancels by construction. With the edges written in the triangle's orthonormal rest frame the
deformation F is 3x2, C = FᵀF = [[E, B], [B, G]], and the squared principal stretches are

    λ1 = (E + G) / 2 + sqrt(((E − G) / 2)² + B²),    λ2 = (E G − B²) / λ1.

This form keeps its digits in float32; (tr / 2)² − det does not.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Float, Float32, Float64, Int, UInt16

from core.buffers import Buffers
from core.descriptors import kernels
from core.descriptors.gathering.kernels import gather
from core.descriptors.kernels import WIDTH
from core.descriptors.patch_means import PatchMeans
from core.descriptors.reading.kernels import UNREADABLE, read_block

MEASURES = {"log": kernels.LOG, "biot": kernels.BIOT, "max": kernels.MAX}
"""`log`: sqrt(ln²σ1 + ln²σ2) (Hencky); `biot`: sqrt((σ1−1)² + (σ2−1)²); `max`: max(|σ1−1|, |σ2−1|). σ = sqrt(λ)."""

TILE = 1024
ROUNDING = 2.0**-20
"""Relative error of the edges of a triangle whose corners were rounded to float32, with room for how they were made."""


UNREADABLE_SAYS = "a coordinate is no number, or too large for one"


class UnreadableError(ValueError):
    """A block of vertices has a coordinate that is not a number, or beyond `kernels.REACH`."""


@dataclass(frozen=True)
class Tile:
    """Neighbouring triangles with vertices of their own: `members` in the mesh, `corners` among the members.

    `shapes` (n, 3) are 1 / a, 1 / c and b / (a c) of the rest triangle with corners (0, 0), (a, 0), (b, c).
    """

    members: Int[np.ndarray, "v"]
    corners: Int[np.ndarray, "n 3"]
    shapes: Float32[np.ndarray, "n 3"]


Packed = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class TriangleStrain:
    """Strain of the triangles of a mesh that have area at rest, in the order `triangles`, of which there are `columns`.

    `areas` (columns,) are the areas at rest; `thinness` (columns,) is 1 / c, so that corners rounded by δ are
    strained by about δ · thinness; `left_out` counts the triangles without area at rest; it `covers` the mesh where
    every vertex is a corner of one that has.
    """

    columns: int
    left_out: int
    triangles: Int[np.ndarray, "columns"]
    areas: Float64[np.ndarray, "columns"]
    thinness: Float64[np.ndarray, "columns"]
    measure: int
    scale_invariant: bool
    parts: tuple[Tile, ...]
    covers: bool

    @classmethod
    def of(
        cls,
        rest: Float[np.ndarray, "V 3"],
        triangles: Int[np.ndarray, "T 3"],
        order: Int[np.ndarray, "T"],
        measure: str = "log",
        scale_invariant: bool = False,
    ) -> "TriangleStrain":
        """Prepare the rest triangles in float64; `order` is a coherent order, so that a tile shares its vertices.

        A triangle whose height is within the rounding of its own corners has no area and takes no part.
        """
        corners = _longest_edge_first(rest, triangles[order])
        origin, first, second = rest[corners.T].astype(np.float64)
        a = np.linalg.norm(first - origin, axis=1)
        doubled = np.linalg.norm(np.cross(first - origin, second - origin), axis=1)
        resolution = 4 * np.finfo(np.float32).eps * np.abs(rest[corners]).max(axis=(1, 2), initial=0)
        kept = doubled > a * resolution
        corners, a, doubled = corners[kept], a[kept], doubled[kept]
        along = np.einsum("tc,tc->t", first - origin, second - origin)[kept]
        c = doubled / a
        shapes = np.stack([1 / a, 1 / c, along / a / a / c], axis=1).astype(np.float32)
        parts = tuple(_tile(corners[i : i + TILE], shapes[i : i + TILE]) for i in range(0, len(corners), TILE))
        left_out = len(triangles) - len(corners)
        areas, covers = doubled / 2, len(np.unique(corners)) == len(rest)
        return cls(len(corners), left_out, order[kept], areas, 1 / c, MEASURES[measure], scale_invariant, parts, covers)

    def tiles(
        self, block: Float32[np.ndarray, "frames V 3"]
    ) -> Iterator[tuple[slice, Float32[np.ndarray, "n frames"]]]:
        """Columns, and their strain in every frame of the block; no unit, from 0. Each array lives until the next.

        A stretch below a thousandth counts as a thousandth. Raises `UnreadableError` where a corner is not a number
        or beyond `kernels.REACH`, for so much is known once the vertices are at hand.
        """
        frames = len(block)
        scale = _to_width(self._scale(block))
        rows = self._buffers.empty((self._most_members, 3, WIDTH), np.float32)
        tile = self._buffers.empty((TILE, WIDTH), np.float32)
        scratch, tops = self._buffers.empty((3 * WIDTH,), np.float32), np.empty(TILE, np.int32)
        for number, part in enumerate(self.parts):
            out = tile[: len(part.corners)]
            pieces = []
            for start in range(0, frames, WIDTH):
                width = min(frames - start, WIDTH)
                own = rows[: len(part.members)]
                gather(block[start : start + width], part.members, own)
                own[:, :, width:] = own[:, :, width - 1 : width]  # frames that are not there repeat the last
                if not _readable(own):
                    raise UnreadableError(UNREADABLE_SAYS)
                lines, factors = own.reshape(-1, 3 * WIDTH), scale[start : start + WIDTH]
                kernels.strain_tile(lines, part.corners, part.shapes, factors, self.measure, scratch, out, tops)
                if frames != WIDTH:
                    pieces.append(out[:, :width].copy())
            yield slice(number * TILE, number * TILE + len(out)), np.concatenate(pieces, axis=1) if pieces else out

    def read(
        self,
        block: Float32[np.ndarray, "frames V 3"],
        noise: Float32[np.ndarray, "columns"],
        coding: tuple[np.int32, np.int32],
        means: tuple[PatchMeans, Float32[np.ndarray, "patches frames"]],
        codes: UInt16[np.ndarray, "kept row"],
        histogram: Int[np.ndarray, "codes"],
    ) -> tuple[float, int]:
        """All `tiles` in one call: adds to means and counts, and writes codes where there are rows.

        `coding` is the lowest code's leading bits and the code from which on codes are counted. Returns the largest
        strain and how many are above noise. Raises `UnreadableError`.
        """
        packed, (patches, sums) = self._packed, means
        rows = self._buffers.empty((self._most_members, 3, WIDTH), np.float32)
        scratch, tile = self._buffers.empty((3 * WIDTH,), np.float32), self._buffers.empty((TILE, WIDTH), np.float32)
        largest, above = read_block(
            block,
            *packed,
            _to_width(self._scale(block)),
            self.measure,
            noise.view(np.int32),
            *coding,
            patches.patch,
            patches.weight,
            rows,
            scratch,
            tile,
            codes,
            histogram,
            sums,
        )
        if above == UNREADABLE:
            raise UnreadableError(UNREADABLE_SAYS)
        return float(np.int32(largest).view(np.float32)), int(above)

    def thinned(self, most: int) -> "TriangleStrain":
        """About so many of the triangles, evenly spread and packed anew: enough for a look.

        All of them where every frame's whole area is needed.
        """
        step = self.columns // most
        if self.scale_invariant or step <= 1:
            return self
        corners = np.concatenate([part.members[part.corners[::step]] for part in self.parts])
        shapes = np.concatenate([part.shapes[::step] for part in self.parts])
        parts = tuple(_tile(corners[i : i + TILE], shapes[i : i + TILE]) for i in range(0, len(corners), TILE))
        return replace(self, columns=len(corners), parts=parts)

    def noise(self, reach: float) -> Float32[np.ndarray, "columns"]:
        """The strain that rounding alone gives each triangle where coordinates go up to `reach`."""
        return (ROUNDING * reach * self.thinness).astype(np.float32)

    @cached_property
    def _packed(self) -> Packed:
        """The parts, end to end: members and where those of each part begin, corners and where, shapes."""
        members, corners = [part.members for part in self.parts], [part.corners for part in self.parts]
        ends = [np.cumsum([0, *map(len, pieces)]) for pieces in (members, corners)]
        shapes = np.concatenate([part.shapes for part in self.parts])
        return np.concatenate(members), ends[0], np.concatenate(corners), ends[1], shapes

    @cached_property
    def _buffers(self) -> Buffers:
        return Buffers()

    @property
    def _most_members(self) -> int:
        return max((len(part.members) for part in self.parts), default=0)

    def _scale(self, block: Float32[np.ndarray, "frames V 3"]) -> Float32[np.ndarray, "frames"]:
        """What the squared stretches are multiplied by: rest area over the frame's, or 1."""
        if not self.scale_invariant:
            return np.ones(len(block), np.float32)
        rows, twice = np.empty((self._most_members, 3, len(block)), np.float32), np.zeros(len(block), np.float64)
        for part in self.parts:
            gather(block, part.members, rows)
            kernels.add_areas(rows, part.corners, twice)
        smallest = np.finfo(np.float32).tiny * self.areas.sum()
        return np.asarray(np.minimum(2 * self.areas.sum() / np.maximum(twice, smallest), 1e12), np.float32)


def _to_width(values: Float32[np.ndarray, "frames"]) -> Float32[np.ndarray, "whole"]:
    """The values with the last one repeated up to a multiple of `WIDTH`."""
    missing = -len(values) % WIDTH
    return np.pad(values, (0, missing), mode="edge") if missing else values


def _readable(rows: Float32[np.ndarray, "v 3 width"]) -> bool:
    """Whether every coordinate is a number within reach; NaN is not."""
    largest = kernels.largest_bits(rows.reshape(-1).view(np.int32))
    return bool(np.int32(largest).view(np.float32) <= kernels.REACH)


def _longest_edge_first(rest: Float[np.ndarray, "V 3"], triangles: Int[np.ndarray, "T 3"]) -> Int[np.ndarray, "T 3"]:
    """The same triangles, turned and flipped so that corner 0 to 1 is the longest edge and 2 is nearer to 0.

    Then b ≤ a / 2, and a sliver loses no digits to its long edges. Strain knows no orientation.
    """
    corners = rest[triangles].astype(np.float64)
    lengths = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    turn = (lengths.argmax(axis=1)[:, None] + np.arange(3)) % 3
    turned, lengths = np.take_along_axis(triangles, turn, 1), np.take_along_axis(lengths, turn, 1)
    flip = lengths[:, 1] < lengths[:, 2]
    return np.asarray(np.where(flip[:, None], turned[:, [1, 0, 2]], turned))


def _tile(corners: Int[np.ndarray, "n 3"], shapes: Float32[np.ndarray, "n 3"]) -> Tile:
    members, local = np.unique(corners, return_inverse=True)
    return Tile(members.astype(np.int32), local.reshape(-1, 3).astype(np.int32), np.ascontiguousarray(shapes))
