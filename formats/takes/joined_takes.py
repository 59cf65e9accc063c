"""Several takes of one body, one after the other."""

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from caesura.core.animation import Vertices
from caesura.core.errors import InvalidModel


@dataclass(frozen=True)
class JoinedTakes:
    """Draws frames of takes one after the other; take k begins at frame `first[k]`, the last of which is their end.

    Between two takes the body leaps: nothing is made up there.
    """

    takes: tuple[Vertices, ...]
    first: tuple[int, ...]
    skipped: int = 0

    def __call__(self, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        """Positions of frames [start, stop), counted after the `skipped` ones."""
        at, end = start + self.skipped, stop + self.skipped
        pieces: list[Float[np.ndarray, "block V 3"]] = []
        while at < end or not pieces:
            take = min(bisect_right(self.first, at), len(self.takes)) - 1
            last = min(end, self.first[take + 1])
            pieces.append(self._piece(take, at, last))
            at = last
        return pieces[0] if len(pieces) == 1 else np.concatenate(pieces)

    def _piece(self, take: int, start: int, stop: int) -> Float[np.ndarray, "block V 3"]:
        first = self.first[take]
        try:
            return self.takes[take](start - first, stop - first)
        except InvalidModel as wrong:
            if "frame" in wrong.where:  # of the take, and not of all of them
                wrong.where["frame"] = int(wrong.where["frame"]) + first - self.skipped
            raise
