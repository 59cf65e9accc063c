"""How far the frames are from those that are blended, linearly in time, of the key-frames beside them."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float64, Int


@dataclass(frozen=True)
class ReconstructionError:
    """Running sums of a take of `values` (frames, D): the error of any stretch in O(D)."""

    values: Float64[np.ndarray, "frames D"]
    squares: Float64[np.ndarray, "sums"]
    sums: Float64[np.ndarray, "sums D"]
    moments: Float64[np.ndarray, "sums D"]

    @classmethod
    def of(cls, values: Float[np.ndarray, "frames D"]) -> "ReconstructionError":
        """O(frames · D)."""
        values = values - values.mean(axis=0, dtype=np.float64)
        weighted = np.arange(len(values))[:, None] * values
        squares = np.concatenate([[0.0], np.cumsum(np.einsum("fd,fd->f", values, values))])
        sums, moments = np.zeros((2, len(values) + 1, values.shape[1]))
        np.cumsum(values, axis=0, out=sums[1:])
        np.cumsum(weighted, axis=0, out=moments[1:])
        return cls(values, squares, sums, moments)

    def between(self, start: Int[np.ndarray, "*n"], stop: Int[np.ndarray, "*n"]) -> Float[np.ndarray, "*n"]:
        """Σ |x_f − (x_start + (f − start) / (stop − start) (x_stop − x_start))|² over start < f < stop, at least 0."""
        length = np.maximum(stop - start, 1)
        inner = stop - start - 1
        first, change = self.values[start], self.values[stop] - self.values[start]
        total = self.sums[stop] - self.sums[start + 1]
        along = (self.moments[stop] - self.moments[start + 1] - start[..., None] * total) / length[..., None]
        squares = self.squares[stop] - self.squares[start + 1]
        share = inner / 2.0  # Σ u of u = (f − start) / length
        share_squared = inner * (2 * inner + 1) / (6.0 * length)  # Σ u²
        error = (
            squares
            - 2 * (np.einsum("...d,...d->...", total, first) + np.einsum("...d,...d->...", along, change))
            + inner * np.einsum("...d,...d->...", first, first)
            + 2 * share * np.einsum("...d,...d->...", first, change)
            + share_squared * np.einsum("...d,...d->...", change, change)
        )
        return np.asarray(np.where(inner > 0, np.maximum(error, 0.0), 0.0))

    def of_keys(self, keys: Int[np.ndarray, "*n keys"]) -> Float[np.ndarray, "*n"]:
        """The error of the whole take, from key-frames in order of which the first and the last are its ends."""
        return np.asarray(self.between(keys[..., :-1], keys[..., 1:]).sum(axis=-1))
