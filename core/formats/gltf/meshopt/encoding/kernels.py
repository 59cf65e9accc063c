"""Mode 0 of KHR_meshopt_compression (its appendix A), the other way round; version 0, which EXT_ knows too."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from core.formats.gltf.meshopt.attributes.kernels import BLOCK_BYTES, GROUP, MOST_ELEMENTS

Bytes = NDArray[np.uint8]

TAIL = 32
"""Bytes at the end, at least: zeros, and then the element that differences begin from."""

exact = njit(nogil=True, cache=True)


@exact
def encoded(elements: Bytes) -> Bytes:
    """A stream of elements (count, stride), one at least; the stride is a multiple of 4 up to 256."""
    count, stride = elements.shape
    most = min((BLOCK_BYTES // stride) & ~(GROUP - 1), MOST_ELEMENTS)
    blocks = (count + most - 1) // most
    out = np.zeros(1 + blocks * stride * (most + most // GROUP) + max(TAIL, stride), np.uint8)
    out[0] = 0xA0
    at, before = 1, elements[0].copy()
    deltas = np.zeros(most, np.uint8)
    for start in range(0, count, most):
        block = min(most, count - start)
        for k in range(stride):
            deltas[block:] = 0
            last = np.int64(before[k])
            for i in range(block):
                value = np.int64(elements[start + i, k])
                delta = (value - last) & 255
                deltas[i] = (2 * delta) ^ (255 if delta & 128 else 0)
                last = value
            before[k] = last
            at = _put(deltas, (block + GROUP - 1) // GROUP, out, at)
    at += max(TAIL - stride, 0)
    out[at : at + stride] = elements[0]
    return out[: at + stride]


@exact
def _put(deltas: Bytes, groups: int, out: Bytes, at: int) -> int:
    """One byte of every element in a block: the widths of its groups, and then these; where the next one begins."""
    header = at
    at += (groups + 3) // 4
    for group in range(groups):
        sixteen = deltas[GROUP * group : GROUP * (group + 1)]
        best, least = 3, GROUP
        for mode in range(3):
            size = _size(sixteen, 2 * mode)
            if size < least:
                best, least = mode, size
        out[header + group // 4] |= best << (2 * (group % 4))
        at = _put_group(sixteen, 2 * best if best < 3 else 8, out, at)
    return at


@exact
def _size(sixteen: Bytes, bits: int) -> int:
    """Bytes that a group takes with so many bits each, 0, 2 or 4; more than any has where it cannot."""
    sentinel = (1 << bits) - 1
    beyond = 0
    for delta in sixteen:
        beyond += delta >= sentinel if bits else delta > 0
    if bits == 0:
        return 2 * GROUP if beyond else 0
    return 2 * bits + beyond


@exact
def _put_group(sixteen: Bytes, bits: int, out: Bytes, at: int) -> int:
    """Sixteen deltas of so many bits, those that need more behind them, a byte each."""
    if bits == 0:
        return at
    packed, sentinel = at, (1 << bits) - 1
    at += 2 * bits
    for i in range(GROUP):
        delta = np.int64(sixteen[i])
        short = delta if delta < sentinel else sentinel
        out[packed + i * bits // 8] |= short << (8 - bits - (i * bits) % 8)
        if bits < 8 and delta >= sentinel:
            out[at] = delta
            at += 1
    return at
