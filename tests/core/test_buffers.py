"""Memory that is lent again."""

import gc

import numpy as np

from core.buffers import ALIGNMENT, Buffers


def test_what_nobody_refers_to_is_lent_again():
    """The same place in memory, whatever the type and the shape, where the bytes are as many."""
    buffers = Buffers()
    first = buffers.empty((4, 8), np.float32)
    place = first.ctypes.data
    assert place % ALIGNMENT == 0
    del first
    gc.collect()
    assert buffers.empty((16,), np.int64).ctypes.data == place


def test_a_view_keeps_its_memory():
    """Nothing else is written into what any part of an array still looks at."""
    buffers = Buffers()
    whole = buffers.empty((4, 8), np.float32)
    whole[:] = 7
    column = whole.T[3]
    del whole
    gc.collect()
    buffers.empty((4, 8), np.float32)[:] = 1
    assert column.tolist() == [7] * 4


def test_nothing_is_an_array_too():
    """Of any number of axes."""
    assert Buffers().empty((0, 64), np.uint16).shape == (0, 64)
