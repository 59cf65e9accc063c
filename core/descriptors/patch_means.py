"""The mean of a descriptor on each patch of the surface, weighted by area: its length is the number of patches."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Float64, Int, Int32

from caesura.core.kernels import descriptors


@dataclass(frozen=True)
class PatchMeans:
    """Which patch each column is in, and its share of that patch's area."""

    patches: int
    patch: Int32[np.ndarray, "columns"]
    weight: Float32[np.ndarray, "columns"]

    @classmethod
    def of(cls, patch: Int[np.ndarray, "columns"], areas: Float64[np.ndarray, "columns"]) -> "PatchMeans":
        """The means over the patches that have any column."""
        met, renumbered = np.unique(patch, return_inverse=True)
        total = np.bincount(renumbered, weights=areas, minlength=len(met))
        return cls(len(met), renumbered.astype(np.int32), (areas / total[renumbered]).astype(np.float32))

    def empty(self, frames: int) -> Float32[np.ndarray, "patches frames"]:
        """Means of nothing yet."""
        return np.zeros((self.patches, frames), np.float32)

    def add(
        self,
        columns: slice,
        tile: Float32[np.ndarray, "n frames"],
        means: Float32[np.ndarray, "patches frames"],
    ) -> None:
        """Add the columns of a tile to the means; nothing where there are no patches."""
        if self.patches:
            descriptors.add_weighted(tile, self.weight[columns], self.patch[columns], means)
