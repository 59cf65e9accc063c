"""Counts of codes, made by several threads at once."""

from collections import deque

import numpy as np
from jaxtyping import Int

from caesura.core.block_pass.quantisation import CODES


class ThreadHistograms:
    """Counts of codes for as many threads as ask: integers, whose sum is the same in any order."""

    def __init__(self) -> None:
        self._free: deque[np.ndarray] = deque()

    def take(self) -> Int[np.ndarray, "codes"]:
        """Counts to add to, nobody else's until they are given back."""
        try:
            return self._free.pop()
        except IndexError:
            return np.zeros(CODES, np.int64)

    def give(self, counts: Int[np.ndarray, "codes"]) -> None:
        """Give them back."""
        self._free.append(counts)

    def total(self) -> Int[np.ndarray, "codes"]:
        """The sum of all that was given back."""
        return np.asarray(sum(self._free, np.zeros(CODES, np.int64)))
