"""Curvature: how much rounder or flatter the surface is around each triangle than at rest (Yamauchi et al. 2005).

At every point of the welded mesh, with θ the angles of its triangles, β the signed angles across its edges e and A a
third of the area around it,

    K A = 2π − Σ θ  (π − Σ θ on a border),      H A = ¼ Σ |e| β.

K is Gaussian curvature, 1/r² on a sphere; H mean curvature, 1/r there. Summed over the corners of a triangle, the
value is |K A − K₀ A₀|, in radians, or |H A − H₀ A₀| / √A₀, no unit; neither depends on how large the body is. Gaussian
curvature does not see a sheet being rolled up, for nothing is stretched; mean curvature does.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32

from caesura.core.descriptors.strain import ROUNDING
from caesura.core.mesh.angles import AngleDefect, FoldAngles, Rows, Totals
from caesura.core.mesh.edges import find_hinges
from caesura.core.mesh.mesh import Mesh


@dataclass(frozen=True)
class Curvature:
    """The change of curvature around each triangle; from 0, Gaussian below 4π or so, mean without bound.

    Linear in the triangles: three arctangents for each in every frame, whatever the length of the take.
    """

    mesh: Mesh
    total: Callable[[Rows], Totals]
    at_rest: Float32[np.ndarray, "columns 1"]
    unit: Float32[np.ndarray, "columns 1"]
    rounding: Float32[np.ndarray, "columns"]

    @classmethod
    def of(cls, mesh: Mesh, kind: str = "gaussian") -> "Curvature":
        """`kind` is gaussian or mean."""
        flat, fold = AngleDefect.of(mesh), FoldAngles(find_hinges(mesh.corners))
        total = flat.total if kind == "gaussian" else fold.total
        rounding = flat.rounding(mesh) if kind == "gaussian" else fold.rounding(mesh)
        around = _sum(mesh, slice(None), mesh.cells())
        unit = np.ones_like(around) if kind == "gaussian" else np.sqrt(around)
        at_rest = _sum(mesh, slice(None), total(mesh.rows_at_rest()))
        per_unit = (ROUNDING * np.sqrt(_sum(mesh, slice(None), rounding)) / unit).astype(np.float32)
        return cls(mesh, total, at_rest, unit[:, None].astype(np.float32), per_unit)

    @property
    def columns(self) -> int:
        """How many triangles there are."""
        return len(self.mesh.corners)

    def tiles(
        self, block: Float32[np.ndarray, "frames V 3"]
    ) -> Iterator[tuple[slice, Float32[np.ndarray, "n frames"]]]:
        """Columns, and the change of their curvature in every frame of the block."""
        total = self.total(self.mesh.rows(block))
        for columns in self.mesh.tiles():
            yield columns, np.abs(_sum(self.mesh, columns, total) - self.at_rest[columns]) / self.unit[columns]

    def noise(self, reach: float) -> Float32[np.ndarray, "columns"]:
        """The change that rounding alone gives each triangle where coordinates go up to `reach`."""
        return np.asarray(self.rounding * np.float32(reach))


def _sum(mesh: Mesh, columns: slice, values: np.ndarray) -> np.ndarray:
    return np.asarray(mesh.on_triangles(columns, values) * values.dtype.type(3))
