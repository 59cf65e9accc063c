"""Memory that is used again: the system clears fresh pages one by one, which costs more than what is done in them."""

import math
import weakref
from collections import defaultdict, deque

import numpy as np
from numpy.typing import DTypeLike

ALIGNMENT = 64
"""Bytes of a line of the cache: a row that begins with one is read in fewer."""


class Buffers:
    """Lends arrays of any shape, from several threads; what nobody refers to any more is lent again.

    Not even a view of an array outlives it, for views refer to what they look into.
    """

    def __init__(self) -> None:
        self._free: defaultdict[int, deque[tuple[memoryview, int]]] = defaultdict(deque)

    def empty(self, shape: tuple[int, ...], dtype: DTypeLike) -> np.ndarray:
        """An array with anything in it."""
        kind = np.dtype(dtype)
        count = math.prod(shape)
        size = count * kind.itemsize + ALIGNMENT
        try:
            memory, start = self._free[size].pop()
        except IndexError:
            fresh = np.empty(size, np.uint8)
            memory, start = memoryview(fresh), -fresh.ctypes.data % ALIGNMENT  # type: ignore[arg-type]  # a buffer
        line = np.frombuffer(memory, kind, count, start) if count else np.empty(0, kind)
        weakref.finalize(line, self._free[size].append, (memory, start)).atexit = False
        return line.reshape(shape)
