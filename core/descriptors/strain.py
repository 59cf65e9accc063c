"""Strain: how much each triangle is stretched or squeezed in its own plane, against the rest shape (paper, section 3).

Rigid motion cancels by construction. With the edges written in the triangle's orthonormal rest frame the
deformation F is 3x2, C = FᵀF = [[E, B], [B, G]], and the squared principal stretches are

    λ1 = (E + G) / 2 + sqrt(((E − G) / 2)² + B²),    λ2 = (E G − B²) / λ1.

This form keeps its digits in float32; (tr / 2)² − det does not.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float, Float32, Float64, Int, Int32

from caesura.core.frames.sampled_frames import ROUNDING
from caesura.core.frames.vertex_rows import gather_rows, rows_of
from caesura.core.kernels import descriptors
from caesura.core.kernels.descriptors import TILE, WIDTH

if TYPE_CHECKING:
    from caesura.core.descriptors.descriptor import DescriptorInput

MEASURES = {"log": descriptors.LOG, "biot": descriptors.BIOT, "max": descriptors.MAX}
"""`log`: sqrt(ln²σ1 + ln²σ2) (Hencky); `biot`: sqrt((σ1−1)² + (σ2−1)²); `max`: max(|σ1−1|, |σ2−1|). σ = sqrt(λ)."""


@dataclass(frozen=True)
class Tile:
    """Neighbouring triangles with vertices of their own: `members` in the mesh, `corners` among the members.

    `shapes` (n, 3) are 1 / a, 1 / c and b / (a c) of the rest triangle with corners (0, 0), (a, 0), (b, c).
    """

    members: Int[np.ndarray, "v"]
    corners: Int[np.ndarray, "n 3"]
    shapes: Float32[np.ndarray, "n 3"]

    @cached_property
    def in_mesh(self) -> Int32[np.ndarray, "n 3"]:
        """The corners among the vertices of the mesh."""
        return np.ascontiguousarray(self.members[self.corners], np.int32)


@dataclass(frozen=True)
class TriangleStrain:
    """Strain of the triangles of a mesh that have area at rest, in the order `triangles`, of which there are `columns`.

    `areas` (columns,) are the areas at rest; `thinness` (columns,) is 1 / c, so that corners rounded by δ are
    strained by about δ · thinness; `left_out` counts the triangles without area at rest.
    """

    columns: int
    left_out: int
    triangles: Int[np.ndarray, "columns"]
    areas: Float64[np.ndarray, "columns"]
    thinness: Float64[np.ndarray, "columns"]
    measure: int
    parts: tuple[Tile, ...]

    @classmethod
    def from_input(cls, subject: "DescriptorInput") -> "TriangleStrain":
        """That of the input, which has it already."""
        return subject.strain

    @classmethod
    def of(
        cls,
        rest: Float[np.ndarray, "V 3"],
        triangles: Int[np.ndarray, "T 3"],
        order: Int[np.ndarray, "T"],
        measure: str = "log",
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
        return cls(len(corners), left_out, order[kept], doubled / 2, 1 / c, MEASURES[measure], parts)

    def tiles(
        self, block: Float32[np.ndarray, "frames V 3"]
    ) -> Iterator[tuple[slice, Float32[np.ndarray, "n frames"]]]:
        """Columns, and their strain in every frame of the block; no unit, from 0. Each array lives until the next.

        A stretch below a thousandth counts as a thousandth.
        """
        whole = rows_of(block) if len(block) == WIDTH else None
        whole = whole if whole is None else whole.reshape(-1, 3 * WIDTH)
        rows = np.empty((max((len(part.members) for part in self.parts), default=0), 3, WIDTH), np.float32)
        tile = np.empty((TILE, WIDTH), np.float32)
        for number, part in enumerate(self.parts):
            own, out, pieces = rows[: len(part.members)], tile[: len(part.corners)], []
            for start in range(0, len(block), WIDTH):
                width = min(len(block) - start, WIDTH)
                if whole is not None:
                    descriptors.strain_tile(whole, part.in_mesh, part.shapes, self.measure, out)
                else:
                    gather_rows(block, part.members, own, start)
                    own[:, :, width:] = own[:, :, width - 1 : width]  # frames that are not there repeat the last
                    descriptors.strain_tile(own.reshape(-1, 3 * WIDTH), part.corners, part.shapes, self.measure, out)
                if len(block) != WIDTH:
                    pieces.append(out[:, :width].copy())
            yield slice(number * TILE, number * TILE + len(out)), np.concatenate(pieces, axis=1) if pieces else out

    def sample_triangles(self, most: int) -> "TriangleStrain":
        """About so many of the triangles, evenly spread and packed anew: enough for a look."""
        step = self.columns // most
        if step <= 1:
            return self
        corners = np.concatenate([part.members[part.corners[::step]] for part in self.parts])
        shapes = np.concatenate([part.shapes[::step] for part in self.parts])
        parts = tuple(_tile(corners[i : i + TILE], shapes[i : i + TILE]) for i in range(0, len(corners), TILE))
        return replace(self, columns=len(corners), parts=parts)

    def noise(self, reach: float) -> Float32[np.ndarray, "columns"]:
        """The strain that rounding alone gives each triangle where coordinates go up to `reach`."""
        return (ROUNDING * reach * self.thinness).astype(np.float32)


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
