"""Joint counts by bits: 64 triangles at a time, where counting one by one would be a load and a store for each.

For every frame and every edge between bins there is a row of bits, one a triangle: does its strain exceed the edge?
With R(i, j) the number of triangles that exceed edge i at one time and edge j at another, which is a population
count of two rows under AND, the triangles in bin i at the one time and bin j at the other are

    C(i, j) = R(i, j) - R(i + 1, j) - R(i, j + 1) + R(i + 1, j + 1),

where every triangle exceeds edge 0 and none the last. (B - 1)^2 words a pair of frames and 64 triangles.
"""

from typing import Any

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray

from core.kernels import Codes

Words = NDArray[np.uint64]

WORD = 64
"""Triangles in a word."""

RUN = 256
"""Words of a row that are counted before the next ones, so that all rows of two frames are in the nearest cache."""

_CODES = ir.VectorType(ir.IntType(16), WORD)


def _exceed(_: Any, codes: Any, _frame: Any, _column: Any, _edge: Any) -> Any:
    """Says to numba, which asks with its own types, what `exceed` takes and which instructions it is."""

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        _, frame, column, edge = given
        source = context.make_array(signature.args[0])(context, builder, given[0])
        place = cgutils.get_item_pointer(context, builder, signature.args[0], source, (frame, column))
        values = builder.load(builder.bitcast(place, _CODES.as_pointer()), align=2)
        first = builder.insert_element(ir.Constant(_CODES, ir.Undefined), edge, ir.Constant(ir.IntType(32), 0))
        edges = builder.shuffle_vector(first, first, ir.Constant(ir.VectorType(ir.IntType(32), WORD), [0] * WORD))
        return builder.bitcast(builder.icmp_unsigned(">", values, edges), ir.IntType(WORD))

    return types.uint64(codes, types.int64, types.int64, types.uint16), generate


def _population(_: Any, _word: Any) -> Any:
    def generate(_context: Any, builder: Any, _signature: Any, given: Any) -> Any:
        return builder.ctpop(given[0])

    return types.uint64(types.uint64), generate


_exceeding: Any = intrinsic(_exceed)
"""_exceeding(codes, f, column, edge): bit k says whether codes[f, column + k] > edge, for k = 0 ... 63."""

_bits_set: Any = intrinsic(_population)
"""_bits_set(word): how many bits of it are 1."""


@njit(nogil=True, cache=True)
def exceed(codes: Codes, edges: Codes, words: Words) -> None:
    """words[f, i, w]: which of codes[f, 64 w ...] are above edges[i]. Rows of codes are whole words long."""
    for f in range(words.shape[0]):
        for w in range(words.shape[2]):
            for i in range(edges.size):
                words[f, i, w] = _exceeding(codes, f, w * WORD, edges[i])


@njit(nogil=True, cache=True)
def _common(one: Words, other: Words) -> np.uint64:
    """How many triangles exceed both; both in one piece, so that the loop becomes vector instructions."""
    found = np.uint64(0)
    for w in range(one.size):
        found += _bits_set(one[w] & other[w])
    return found


@njit(nogil=True, cache=True)
def _add_exceeding(first: Words, second: Words, found: NDArray[np.int64]) -> None:
    """found[i + 1, j + 1] += R of a pair of frames; its first row and column take what exceeds in one frame alone."""
    for start in range(0, first.shape[1], RUN):
        stop = min(start + RUN, first.shape[1])
        for i in range(first.shape[0]):
            one, other = first[i][start:stop], second[i][start:stop]
            found[i + 1, 0] += _common(one, one)
            found[0, i + 1] += _common(other, other)
            for j in range(second.shape[0]):
                found[i + 1, j + 1] += _common(one, second[j][start:stop])


@njit(nogil=True, cache=True)
def count_pairs(first: Words, second: Words, columns: int, counts: NDArray[np.int32]) -> None:
    """counts[f, i B + j] = how many of the columns are in bin i of frame f of `first` and in bin j of `second`'s."""
    levels = first.shape[1] + 1
    found = np.empty((levels + 1, levels + 1), np.int64)
    for f in range(counts.shape[0]):
        found[:] = 0
        found[0, 0] = columns
        _add_exceeding(first[f], second[f], found)
        for i in range(levels):
            for j in range(levels):
                counts[f, i * levels + j] = found[i, j] - found[i + 1, j] - found[i, j + 1] + found[i + 1, j + 1]
