"""Frames of vertices that lie somewhere as an array, drawn by blocks."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Shaped

from caesura.core.errors import InvalidModel

BLOCK_BYTES = 2**26


@dataclass(frozen=True)
class VertexSequence:
    """Draws frames of `stored` (F, V, 3), of any kind of number and order, from `first` on in steps of `step` frames.

    Between stored frames vertices go straight. `stored` may lie on disk: only what is asked for is touched.
    """

    stored: Shaped[np.ndarray, "F V 3"]
    step: float = 1.0
    first: float = 0.0

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        """Positions of frames [start, stop); raises `non-finite-data` naming frame and vertex."""
        if self.step == 1 and self.first.is_integer():
            skipped = int(self.first)
            block = _as_float32(self.stored[skipped + start : skipped + stop])
        else:
            at = np.minimum(self.first + np.arange(start, stop) * self.step, len(self.stored) - 1)
            before = np.minimum(at.astype(np.int64), len(self.stored) - 2)
            share = (at - before)[:, None, None]
            block = _as_float32(self.stored[before] * (1 - share) + self.stored[before + 1] * share)
        if not require_finite(block):
            frame, vertex = np.argwhere(~np.isfinite(block).all(axis=2))[0].tolist()
            raise InvalidModel(
                "non-finite-data", "A vertex is not at a finite place.", frame=start + frame, vertex=vertex
            )
        return block


def require_finite(values: Float[np.ndarray, "..."]) -> bool:
    """Whether all of `values` are finite; a sum of squares tells without an array of answers."""
    flat = values.reshape(-1)
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.isfinite(flat.dot(flat))) or bool(np.isfinite(flat).all())


def _as_float32(block: Shaped[np.ndarray, "block V 3"]) -> Float[np.ndarray, "block V 3"]:
    with np.errstate(over="ignore"):
        return np.require(block, np.float32, ["C_CONTIGUOUS", "ALIGNED"])
