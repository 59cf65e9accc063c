"""Vertices of a block of frames, turned so that the frames of a coordinate lie next to each other in memory.

In a file the axes of a vertex are neighbours, and the same vertex in the next frame is a whole mesh away. Four frames
of one vertex are four short loads; turned in registers, they are three short stores. Compiled from plain loops it
would be twelve of each, for the compiler does not turn matrices by itself.
"""

from typing import Any

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Indices = NDArray[np.int32]

LINE = 16
"""Floats in a line of the cache."""

_ZERO = ir.Constant(ir.IntType(64), 0)
_FOUR = ir.VectorType(ir.FloatType(), 4)
_INTERLEAVED_LOW, _INTERLEAVED_HIGH = (0, 4, 1, 5), (2, 6, 3, 7)
_LOWER_HALVES, _UPPER_HALVES = (0, 1, 4, 5), (2, 3, 6, 7)


def _turn(_: Any, vertices: Any, _frame: Any, _vertex: Any, rows: Any, _row: Any) -> Any:
    """Says to numba, which asks with its own types, what `turn_four` takes and which instructions it is."""

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        source, target = (context.make_array(signature.args[i])(context, builder, given[i]) for i in (0, 3))
        _, frame, vertex, _, row = given

        def place(array: Any, kind: Any, *index: Any) -> Any:
            return builder.bitcast(cgutils.get_item_pointer(context, builder, kind, array, index), _FOUR.as_pointer())

        def constant(value: int) -> Any:
            return ir.Constant(ir.IntType(64), value)

        def pick(one: Any, other: Any, lanes: tuple[int, ...]) -> Any:
            return builder.shuffle_vector(one, other, ir.Constant(ir.VectorType(ir.IntType(32), 4), lanes))

        frames = [builder.add(frame, constant(k)) for k in range(4)]
        a, b, c, d = (builder.load(place(source, vertices, f, vertex, constant(0)), align=4) for f in frames)
        early, late = pick(a, b, _INTERLEAVED_LOW), pick(c, d, _INTERLEAVED_LOW)  # x x y y of two frames each
        x, y = pick(early, late, _LOWER_HALVES), pick(early, late, _UPPER_HALVES)
        z = pick(pick(a, b, _INTERLEAVED_HIGH), pick(c, d, _INTERLEAVED_HIGH), _LOWER_HALVES)
        for axis, turned in enumerate((x, y, z)):
            builder.store(turned, place(target, rows, row, constant(axis), frame), align=4)
        return context.get_dummy_value()

    return types.void(vertices, types.int64, types.int64, rows, types.int64), generate


_turn_four: Any = intrinsic(_turn)
"""_turn_four(vertices, f, v, rows, i): rows[i, axis, f + k] = vertices[f + k, v, axis] for k = 0 … 3.

Reads one float after the vertex, so v must not be the last of the mesh.
"""


def _fetch(_: Any, vertices: Any, _frame: Any, _vertex: Any) -> Any:
    """Says to numba, which asks with its own types, what `fetch_ahead` takes and which instruction it is."""

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        source = context.make_array(signature.args[0])(context, builder, given[0])
        place = cgutils.get_item_pointer(context, builder, signature.args[0], source, (*given[1:], _ZERO))
        flag, byte = ir.IntType(32), ir.IntType(8).as_pointer()
        called = ir.FunctionType(ir.VoidType(), [byte, flag, flag, flag])
        fetch = cgutils.get_or_insert_function(builder.module, called, "llvm.prefetch.p0")
        builder.call(fetch, [builder.bitcast(place, byte), *(ir.Constant(flag, value) for value in (0, 2, 1))])
        return context.get_dummy_value()

    return types.void(vertices, types.int64, types.int64), generate


_fetch_ahead: Any = intrinsic(_fetch)
"""_fetch_ahead(vertices, f, v): asks the memory for the line of vertices[f, v], and does not wait for it."""


@njit(nogil=True, cache=True, error_model="numpy")
def fetch(vertices: Floats, members: Indices, start: int, stop: int) -> None:
    """Ask for the members' places in frames [start, stop), while something else is computed; every line about once.

    In coherent order, neighbours in the list are neighbours in memory, five or more to a line.
    """
    for f in range(start, min(stop, vertices.shape[0])):
        for i in range(0, members.size, 4):
            _fetch_ahead(vertices, f, members[i])


@njit(nogil=True, cache=True, error_model="numpy")
def gather(vertices: Floats, members: Indices, rows: Floats) -> None:
    """rows[i, axis, f] = vertices[f, members[i], axis].

    Sixteen frames at a time: they fill a line of the cache in each row.
    """
    frames, last = vertices.shape[0], vertices.shape[1] - 1
    fours = frames // 4 * 4
    for start in range(0, fours, LINE):
        stop = min(start + LINE, fours)
        for i in range(members.size):
            if members[i] != last:
                for f in range(start, stop, 4):
                    _turn_four(vertices, f, members[i], rows, i)
            else:
                _copy_frames(vertices, start, stop, members[i], rows[i])
    for i in range(members.size):
        _copy_frames(vertices, fours, frames, members[i], rows[i])


@njit(nogil=True, cache=True, error_model="numpy", inline="always")
def _copy_frames(vertices: Floats, start: int, stop: int, vertex: int, row: Floats) -> None:
    for f in range(start, stop):
        for axis in range(3):
            row[axis, f] = vertices[f, vertex, axis]
