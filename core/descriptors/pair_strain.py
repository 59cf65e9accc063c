"""Strain without triangles: how much the distance of two points is stretched, |ln(d / d0)|.

A skeleton has no triangles, and those of a robot never strain; the pairs of points that also make the pair
distances stand in for triangles then, so that such a take has an energy curve too.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Int

from caesura.core.descriptors.pair_distances import PairDistances
from caesura.core.descriptors.strain import ROUNDING

LIMB = (0.06, 0.3)
"""Shares of the body's size that the ends of a limb's joint are apart: not as near as fingers, nor across the body."""

LEAST = np.float32(1e-3)
"""The least stretch: a distance below a thousandth of that at rest counts as a thousandth."""


@dataclass(frozen=True)
class PairStrain:
    """|ln(d / d0)| of the pairs that are apart at rest; no unit, 0 to ln 1000 when squeezed."""

    first: Int[np.ndarray, "columns"]
    second: Int[np.ndarray, "columns"]
    at_rest: Float32[np.ndarray, "columns"]

    @classmethod
    def of(cls, pairs: PairDistances) -> "PairStrain":
        """The same pairs, less those that coincide at rest."""
        apart = pairs.at_rest > ROUNDING * pairs.size
        return cls(pairs.first[apart], pairs.second[apart], pairs.at_rest[apart])

    @property
    def columns(self) -> int:
        """How many pairs there are."""
        return len(self.first)

    @classmethod
    def of_limbs(cls, pairs: PairDistances) -> "PairStrain":
        """The pairs across one joint or two, as far apart at rest as `LIMB` says; all where there are none.

        They shorten where a limb bends, which is where a skin would strain: a skeleton is cut as its mesh is.
        """
        shares = pairs.at_rest / (pairs.size or 1.0)
        across = (shares >= LIMB[0]) & (shares <= LIMB[1])
        return cls(pairs.first[across], pairs.second[across], pairs.at_rest[across]) if across.any() else cls.of(pairs)

    def tiles(
        self, block: Float32[np.ndarray, "frames V 3"]
    ) -> Iterator[tuple[slice, Float32[np.ndarray, "columns frames"]]]:
        """All columns, and their strain in every frame of the block."""
        apart = block[:, self.first] - block[:, self.second]
        stretch = np.sqrt(np.einsum("fpc,fpc->pf", apart, apart)) / self.at_rest[:, None]
        yield slice(0, self.columns), np.abs(np.log(np.maximum(stretch, LEAST)))

    def noise(self, reach: float) -> Float32[np.ndarray, "columns"]:
        """The strain that rounding alone gives each pair where coordinates go up to `reach`."""
        return (ROUNDING * reach / self.at_rest).astype(np.float32)
