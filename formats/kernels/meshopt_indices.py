"""Modes 1 and 2 of KHR_meshopt_compression (its appendix A). Every read is within the data, or the answer is False."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Words = NDArray[np.int64]

MASK = 0xFFFFFFFF
NOTHING = -1
EXPLICIT_INDEX = 15
AT, LAST, NEXT, EDGES, VERTICES = 0, 1, 2, 3, 4
"""Places in the state of a triangle decoder: of the data, two running indices, and how much went into the queues."""

exact = njit(nogil=True, cache=True)


@exact
def decode_index_sequence(data: Bytes, out: Words) -> bool:
    """Mode 2: numbers as differences from one of two that went before."""
    end = len(data) - 4
    if end < 1 or data[0] != 0xD1:
        return False
    last, state = np.zeros(2, np.int64), np.zeros(5, np.int64)
    state[AT] = 1
    for i in range(len(out)):
        value = _number(data, end, state)
        if value < 0:
            return False
        base = value & 1
        last[base] = (last[base] + _signed(value >> 1)) & MASK
        out[i] = last[base]
    return bool(state[AT] == end)


@exact
def decode_triangles(data: Bytes, out: Words) -> bool:
    """Mode 1: out (triangles, 3). A triangle is a code of one byte, from queues of recent edges and vertices."""
    end = len(data) - 16
    if end < 1 + len(out) or data[0] != 0xE1:
        return False
    table = data[end:]
    edges, vertices = np.full((16, 2), NOTHING), np.full(16, NOTHING)
    state = np.zeros(5, np.int64)
    state[AT] = 1 + len(out)
    for i in range(len(out)):
        code = data[1 + i] & 255
        if code < 0xF0:
            good = _beside_an_edge(code, data, end, state, edges, vertices, out[i])
        else:
            good = _alone(code, table, data, end, state, vertices, out[i])
            if good:
                _push_edge(edges, state, out[i, 1], out[i, 0])
        if not good:
            return False
        _push_edge(edges, state, out[i, 2], out[i, 1])
        _push_edge(edges, state, out[i, 0], out[i, 2])
    return bool(state[AT] == end)


@exact
def _beside_an_edge(code: int, data: Bytes, end: int, state: Words, edges: Words, vertices: Words, out: Words) -> bool:
    """A recent edge, and a vertex that is next, recent, near the last one, or told."""
    edge, way = code >> 4, code & 15
    place = (state[EDGES] - 1 - edge) & 15
    out[0], out[1] = edges[place, 0], edges[place, 1]
    if way == 0:
        out[2] = _next(state)
    elif way < 13:
        out[2] = vertices[(state[VERTICES] - 1 - way) & 15]
    elif way < 15:
        state[LAST] = (state[LAST] + (1 if way == 14 else -1)) & MASK
        out[2] = state[LAST]
    else:
        out[2] = _explicit_index(data, end, state)
    if out[0] < 0 or out[2] < 0:
        return False
    if way == 0 or way > 12:
        _push_vertex(vertices, state, out[2])
    return True


@exact
def _alone(code: int, table: Bytes, data: Bytes, end: int, state: Words, vertices: Words, out: Words) -> bool:
    """Three vertices, each next, recent, or told, as a byte of the table or of the data says."""
    if code >= 0xFE:
        if state[AT] >= end:
            return False
        ways = data[state[AT]] & 255
        state[AT] += 1
        if ways == 0:
            state[NEXT] = 0
    else:
        ways = table[code & 15] & 255
        if ways >> 4 == EXPLICIT_INDEX or ways & 15 == EXPLICIT_INDEX:
            return False
    second, third = ways >> 4, ways & 15
    out[0] = _explicit_index(data, end, state) if code == 0xFF else _next(state)
    out[1] = _vertex(second, data, end, state, vertices)
    out[2] = _vertex(third, data, end, state, vertices)
    if out[0] < 0 or out[1] < 0 or out[2] < 0:
        return False
    _push_vertex(vertices, state, out[0])
    if second in {0, EXPLICIT_INDEX}:
        _push_vertex(vertices, state, out[1])
    if third in {0, EXPLICIT_INDEX}:
        _push_vertex(vertices, state, out[2])
    return True


@exact
def _vertex(way: int, data: Bytes, end: int, state: Words, vertices: Words) -> int:
    """The next vertex, a told one, or a recent one, `NOTHING` where there were fewer."""
    if way == 0:
        return _next(state)
    if way == EXPLICIT_INDEX:
        return _explicit_index(data, end, state)
    recent: int = vertices[(state[VERTICES] - way) & 15]
    return recent


@exact
def _next(state: Words) -> int:
    """The first index that has not occurred."""
    fresh: int = state[NEXT]
    state[NEXT] = (fresh + 1) & MASK
    return fresh


@exact
def _explicit_index(data: Bytes, end: int, state: Words) -> int:
    """An index by its difference from the last one told, or `NOTHING`."""
    value = _number(data, end, state)
    if value < 0:
        return NOTHING
    index: int = (state[LAST] + _signed(value)) & MASK
    state[LAST] = index
    return index


@exact
def _number(data: Bytes, end: int, state: Words) -> int:
    """A number of one to five bytes (LEB128), or `NOTHING`."""
    value = 0
    for i in range(5):
        if state[AT] >= end:
            return NOTHING
        byte = data[state[AT]] & 255
        state[AT] += 1
        value |= (byte & 127) << (7 * i)
        if byte < 128:
            number: int = value & MASK
            return number
    return NOTHING


@exact
def _signed(value: int) -> int:
    """The difference that a number stands for: 0, -1, 1, -2, …"""
    return (value >> 1) ^ -(value & 1)


@exact
def _push_edge(edges: Words, state: Words, a: int, b: int) -> None:
    edges[state[EDGES] & 15, 0], edges[state[EDGES] & 15, 1] = a, b
    state[EDGES] += 1


@exact
def _push_vertex(vertices: Words, state: Words, vertex: int) -> None:
    vertices[state[VERTICES] & 15] = vertex
    state[VERTICES] += 1
