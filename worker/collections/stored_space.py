"""The pose space of a collection as a blob: learned from its takes once, and the same for all that come later."""

import io
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from caesura.core.together.pose_space import PoseSpace
from caesura.core.together.pose_space_file import space_from_arrays, space_to_arrays


@dataclass(frozen=True)
class StoredSpace:
    """The space, and how far segments are apart in it: `spreads` (3,), as `MotionSignatures.spreads`."""

    space: PoseSpace
    spreads: Float[np.ndarray, "3"]

    def to_bytes(self) -> bytes:
        """As an NPZ of plain arrays."""
        out = io.BytesIO()
        np.savez(out, **space_to_arrays(self.space), spreads=self.spreads)
        return out.getvalue()

    @classmethod
    def from_bytes(cls, data: bytes) -> "StoredSpace":
        """The space that `to_bytes` wrote."""
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            return cls(space_from_arrays(stored), stored["spreads"])
