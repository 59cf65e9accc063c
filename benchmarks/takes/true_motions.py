"""The true motions of a take, against which labels are scored."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int

from caesura.core.agreement import frame_accuracy


@dataclass(frozen=True)
class TrueMotions:
    """The true motion of every frame, and which frames are scored."""

    truth: Int[np.ndarray, "frames"]
    scored: Bool[np.ndarray, "frames"]

    @property
    def motions(self) -> int:
        """How many there truly are."""
        return len(np.unique(self.truth[self.scored]))

    def accuracy(self, labels: Int[np.ndarray, "frames"]) -> float:
        """Frame accuracy over the scored frames."""
        return frame_accuracy(labels[self.scored], self.truth[self.scored])
