"""Strain in 16 bits, and the strain that counts as 1, exact to the code, from the histogram of the codes.

A code is the top of a float32: 4 bits of exponent and 12 of mantissa. The step is 1/4096 of the value or less,
so a bin's edge in codes is within 1/8192 of its place, over 16 octaves that a power of two (`gain`) moves to
where the data are.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Int, UInt8, UInt16

from caesura.core.kernels import counting
from caesura.core.kernels.counting import SHIFT

LOWEST = int(np.float32(2.0**-12).view(np.int32)) >> SHIFT
CODES = 2**16
EXPONENTS = (-112, 100)
"""Of the numbers that are coded: zero has code 0, and the largest float32 the last."""
PERCENTILE = 99.9


@dataclass(frozen=True)
class Quantisation:
    """Codes of 2⁻¹² / gain (and all below: code 0) to 16 / gain (and all above)."""

    gain: float

    @classmethod
    def for_largest(cls, largest: float) -> "Quantisation":
        """The coding for values whose largest so far is `largest`: 8 times more still fits."""
        return cls(2.0 ** -float(np.clip(np.floor(np.log2(largest)), *EXPONENTS)) if largest > 0 else 1.0)

    def encode(self, values: Float32[np.ndarray, "*shape"]) -> UInt16[np.ndarray, "*shape"]:
        """The codes of values ≥ 0; larger values never have smaller codes."""
        return np.asarray(np.clip((values.view(np.int32) >> SHIFT) - self.lowest, 0, CODES - 1), np.uint16)

    def count(
        self,
        values: Float32[np.ndarray, "columns frames"],
        noise: Float32[np.ndarray, "columns"],
        floor: int,
        histogram: Int[np.ndarray, "codes"],
    ) -> tuple[float, int]:
        """Add the codes of values ≥ 0 to the histogram, those below `floor` as code 0.

        Returns the largest value, and how many are above their column's noise.
        """
        bits = np.ascontiguousarray(values).view(np.int32)
        largest, above = counting.count_codes(bits, noise.view(np.int32), self.lowest, np.int32(floor), histogram)
        return float(np.int32(largest).view(np.float32)), int(above)

    def write(self, values: Float32[np.ndarray, "columns frames"], codes: UInt16[np.ndarray, "columns frames"]) -> None:
        """Write the codes of values ≥ 0."""
        counting.write_codes(np.ascontiguousarray(values).view(np.int32), self.lowest, codes)

    @property
    def lowest(self) -> np.int32:
        """The leading bits of 2⁻¹² / gain: a power of two moves the exponent alone."""
        return np.int32(LOWEST - int(np.log2(self.gain)) * 2 ** (23 - SHIFT))

    def decode(self, position: float) -> float:
        """The value at a position between codes: `decode(c)` is the least value of code c, c ≥ 1; `decode(0)` is 0."""
        if position < 1:
            return position * self.decode(1.0)
        whole = int(position)
        low, high = (float(np.int32((LOWEST + code) << SHIFT).view(np.float32)) for code in (whole, whole + 1))
        return (low + (high - low) * (position - whole)) / self.gain

    def edges(self, scale: float, bins: int) -> UInt16[np.ndarray, "edges"]:
        """Codes c_1 … c_{B−1}: a value is above i / B of `scale` where its code is above c_i, to half a step."""
        above = scale * np.arange(1, bins) / bins * self.gain
        bits = np.asarray(above, np.float32).view(np.int32).astype(np.int64)
        nearest = (bits + 2 ** (SHIFT - 1)) // 2**SHIFT - LOWEST
        return np.asarray(np.clip(nearest - 1, 0, CODES - 2), np.uint16)

    def bins(self, scale: float, bins: int) -> UInt8[np.ndarray, "codes"]:
        """The bin of each code, 0 to B − 1: how many `edges` it is above."""
        return np.searchsorted(self.edges(scale, bins), np.arange(CODES)).astype(np.uint8)

    def shares(self, scale: float) -> Float32[np.ndarray, "codes"]:
        """The middle of each code's values over `scale`, at most 1; 0 for code 0."""
        bits = (LOWEST + np.arange(CODES + 1, dtype=np.int64)) << SHIFT
        edges = bits.astype(np.int32).view(np.float32).astype(np.float64) / self.gain
        middles = np.minimum((edges[:-1] + edges[1:]) / 2 / scale, 1.0)
        middles[0] = 0.0
        return middles.astype(np.float32)

    def resolves_percentile(self, histogram: Int[np.ndarray, "codes"], percent: float = PERCENTILE) -> bool:
        """Whether the percentile is above code 0, which may stand for all codes below a floor."""
        return int(histogram[0]) <= (int(histogram.sum()) - 1) * percent / 100

    def resolves_edges(self, scale: float, bins: int, histogram: Int[np.ndarray, "codes"]) -> bool:
        """Whether the first and the last code lump together nothing that an edge between bins of `scale` parts."""
        highest = int(histogram[-1]) == 0 or scale * (bins - 1) / bins < self.decode(CODES - 1.0)
        return highest and scale / bins >= self.decode(1.0)

    def wider(self) -> "Quantisation":
        """The coding for values 256 times as large."""
        return Quantisation(self.gain / 2**8)

    def reaches_percentile(self, histogram: Int[np.ndarray, "codes"], percent: float = PERCENTILE) -> bool:
        """Whether the percentile is below the last code, which stands for everything above it too.

        By the same rank as `percentile`: else a few values, most of them far below, are measured again for ever.
        """
        total = int(histogram.sum())
        return (total - 1) * percent / 100 < total - int(histogram[-1])

    def percentile(self, histogram: Int[np.ndarray, "codes"], percent: float = PERCENTILE) -> float:
        """The value that `percent` of all values do not exceed, as `np.percentile` defines it.

        Exact to the code, and inside the code's step by rank, as if its values were spread evenly.
        """
        below = np.cumsum(histogram)
        rank = (int(below[-1]) - 1) * percent / 100
        code = int(np.searchsorted(below, rank, side="right"))
        inside = (rank - (int(below[code]) - int(histogram[code])) + 0.5) / int(histogram[code])
        return self.decode(code + min(max(inside, 0.0), 1.0))


def find_normalising_strain(
    rule: str | float,
    coding: Quantisation,
    histogram: Int[np.ndarray, "codes"],
    largest: float,
    share_above_noise: float,
) -> float:
    """The strain that counts as 1: the 99.9th percentile, the largest, a given number, or 1 (`none`).

    Noise is not stretched to full scale: where strain is so rare that the percentile would be noise, the largest
    counts in its place, and where there is none above noise, 1.
    """
    if share_above_noise == 0 and not isinstance(rule, float):
        return 1.0
    if rule == "p99.9" and share_above_noise > 1 - PERCENTILE / 100:
        return coding.percentile(histogram)
    if rule in {"p99.9", "max"}:
        return largest
    return 1.0 if rule == "none" else float(rule)
