"""Codes of a tile of strains: computed in rows of frames, kept in rows of triangles.

Strain is computed for many frames of one triangle at a time; what is asked of the codes later is asked of all
triangles of one frame. So eight frames of eight triangles are turned in registers, where it costs a shuffle for
every second value. Compiled from plain loops, each code would be stored by itself.
"""

from typing import Any

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.core.errors import TypingError
from numba.extending import intrinsic

from core.kernels import SHIFT, Bits, Codes, code_of

EIGHT = 8
_INTEGERS, _SHORTS = ir.VectorType(ir.IntType(32), EIGHT), ir.VectorType(ir.IntType(16), EIGHT)
_ONE_BY_ONE_LOW = [lane for i in range(EIGHT // 2) for lane in (i, EIGHT + i)]
_ONE_BY_ONE_HIGH = [lane for i in range(EIGHT // 2, EIGHT) for lane in (i, EIGHT + i)]


def _constant(value: int) -> Any:
    return ir.Constant(_INTEGERS, [value] * EIGHT)


def _shuffled(builder: Any, one: Any, other: Any, lanes: list[int]) -> Any:
    return builder.shuffle_vector(one, other, ir.Constant(ir.VectorType(ir.IntType(32), len(lanes)), lanes))


def _turned(builder: Any, rows: list[Any]) -> list[Any]:
    """Eight rows as eight columns: three times, each row of the upper half is laced into one of the lower."""
    for _ in range(3):
        pairs = list(zip(rows[: EIGHT // 2], rows[EIGHT // 2 :], strict=True))
        rows = [_shuffled(builder, *pair, lanes) for pair in pairs for lanes in (_ONE_BY_ONE_LOW, _ONE_BY_ONE_HIGH)]
    return rows


def _encode_eight(_: Any, tile: Any, _triangle: Any, _frame: Any, _lowest: Any, codes: Any, _column: Any) -> Any:
    """Says to numba, which asks with its own types, what `encode_eight` takes and which instructions it is."""
    if tile.layout != "C" or codes.layout != "C":
        raise TypingError("Eights are read and written at once, so they must lie one after the other in their rows.")

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        source, target = (context.make_array(signature.args[i])(context, builder, given[i]) for i in (0, 4))
        _, triangle, frame, lowest, _, column = given

        def place(array: Any, kind: Any, pieces: Any, *index: Any) -> Any:
            pointer = cgutils.get_item_pointer(context, builder, kind, array, index)
            return builder.bitcast(pointer, pieces.as_pointer())

        def after(start: Any, k: int) -> Any:
            return builder.add(start, ir.Constant(ir.IntType(64), k))

        def code(bits: Any) -> Any:
            above = builder.sub(builder.ashr(bits, _constant(SHIFT)), from_lowest)
            above = builder.select(builder.icmp_signed(">", above, _constant(0)), above, _constant(0))
            top = builder.select(builder.icmp_signed("<", above, _constant(65535)), above, _constant(65535))
            return builder.trunc(top, _SHORTS)

        one = builder.insert_element(ir.Constant(_INTEGERS, ir.Undefined), lowest, ir.Constant(ir.IntType(32), 0))
        from_lowest = _shuffled(builder, one, one, [0] * EIGHT)
        places = [place(source, signature.args[0], _INTEGERS, after(triangle, k), frame) for k in range(EIGHT)]
        rows = [code(builder.load(pointer, align=4)) for pointer in places]
        for k, row in enumerate(_turned(builder, rows)):
            builder.store(row, place(target, signature.args[4], _SHORTS, after(frame, k), column), align=2)
        return context.get_dummy_value()

    return types.void(tile, types.int64, types.int64, types.int32, codes, types.int64), generate


_encode_eight_by_eight: Any = intrinsic(_encode_eight)
"""_encode_eight_by_eight(tile, t, f, lowest, codes, column): codes[f + k, column + i] of tile[t + i, f + k]."""


@njit(nogil=True, cache=True)
def encode(tile: Bits, frames: int, lowest: np.int32, codes: Codes, column: int) -> None:
    """codes[f, column + t] = code of tile[t, f], for the first frames of the tile."""
    columns = tile.shape[0]
    eights, frame_eights = columns // EIGHT * EIGHT, frames // EIGHT * EIGHT
    for t in range(0, eights, EIGHT):
        for f in range(0, frame_eights, EIGHT):
            _encode_eight_by_eight(tile, t, f, lowest, codes, column + t)
        for f in range(frame_eights, frames):
            for k in range(t, t + EIGHT):
                codes[f, column + k] = code_of(tile[k, f], lowest)
    for t in range(eights, columns):
        for f in range(frames):
            codes[f, column + t] = code_of(tile[t, f], lowest)
