"""Mode 0 of KHR_meshopt_compression (its appendix A). Every read is within the data, or the answer is False."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Words = NDArray[np.int64]

GROUP = 16
MOST_ELEMENTS = 256
BLOCK_BYTES = 8192
NOTHING = -1

exact = njit(nogil=True, cache=True)


@exact
def decode_attributes(data: Bytes, out: Bytes) -> bool:
    """Elements out (count, stride), byte by byte as differences from the one before; versions 0 and 1."""
    count, stride = out.shape
    if len(data) == 0 or (data[0] != 0xA0 and data[0] != 0xA1):
        return False
    second = data[0] == 0xA1
    channels = stride // 4
    tail = stride + channels if second else stride
    end = len(data) - max(tail, 24 if second else 32)
    if end < 1:
        return False
    element = data[len(data) - tail : len(data) - tail + stride].astype(np.int64)
    modes = np.zeros(channels, np.int64)
    if second:
        modes[:] = data[len(data) - channels :]
    most = min((BLOCK_BYTES // stride) & ~(GROUP - 1), MOST_ELEMENTS)
    deltas = np.zeros((stride, MOST_ELEMENTS), np.int64)
    at = 1
    for start in range(0, count, most):
        block = min(most, count - start)
        control = at
        at += channels if second else 0
        if at > end:
            return False
        for k in range(stride):
            mode = (data[control + k // 4] >> (2 * (k % 4))) & 3 if second else NOTHING
            at = _deltas(data, at, end, mode, block, deltas[k])
            if at < 0:
                return False
        for c in range(channels):
            if not _sum(deltas[4 * c : 4 * c + 4], modes[c], element[4 * c : 4 * c + 4], out[start : start + block], c):
                return False
    return bool(at == end)


@exact
def _deltas(data: Bytes, at: int, end: int, mode: int, block: int, out: Words) -> int:
    """One byte of every element in a block, as stored; where the next one begins, or `NOTHING`."""
    if mode == 2:
        out[:] = 0
        return at
    if mode == 3:
        if at + block > end:
            return NOTHING
        out[:block] = data[at : at + block]
        return at + block
    groups = (block + GROUP - 1) // GROUP
    header = at
    at += (groups + 3) // 4
    if at > end:
        return NOTHING
    for group in range(groups):
        wide = (data[header + group // 4] >> (2 * (group % 4))) & 3
        # Bits of a delta: 0 2 4 8 in version 0, 0 1 2 4 and 1 2 4 8 in version 1.
        power = wide - 1 if mode == 0 or (mode == NOTHING and wide == 0) else wide
        bits = 0 if power < 0 else 1 << power
        at = _group(data, at, end, bits, out[GROUP * group : GROUP * (group + 1)])
        if at < 0:
            return NOTHING
    return at


@exact
def _group(data: Bytes, at: int, end: int, bits: int, out: Words) -> int:
    """Sixteen deltas of so many bits; one of all bits set stands for a whole byte that follows them."""
    if bits == 0:
        out[:] = 0
        return at
    packed, sentinel = at, (1 << bits) - 1
    at += 2 * bits
    if at > end:
        return NOTHING
    for i in range(GROUP):
        byte = data[packed + i * bits // 8]
        shift = i % 8 if bits == 1 else 8 - bits - (i * bits) % 8
        value = (byte >> shift) & sentinel
        if value == sentinel and bits < 8:
            if at >= end:
                return NOTHING
            value = data[at]
            at += 1
        out[i] = value
    return at


@exact
def _sum(deltas: Words, mode: int, element: Words, out: Bytes, channel: int) -> bool:
    """Four bytes of every element from their deltas; `element` is the one before, and the last one after."""
    kind, turn = mode & 15, mode >> 4
    if kind > 2 or (kind < 2 and turn):
        return False
    width = 4 if kind == 2 else kind + 1
    mask = (1 << (8 * width)) - 1
    for first in range(0, 4, width):
        value = 0
        for b in range(width):
            value |= element[first + b] << (8 * b)
        for i in range(len(out)):
            delta = 0
            for b in range(width):
                delta |= deltas[first + b, i] << (8 * b)
            if kind == 2:
                value ^= ((delta << turn) | (delta >> ((32 - turn) & 31))) & mask
            else:
                value = (value + ((delta >> 1) ^ -(delta & 1))) & mask
            for b in range(width):
                out[i, 4 * channel + first + b] = (value >> (8 * b)) & 255
        for b in range(width):
            element[first + b] = (value >> (8 * b)) & 255
    return True
