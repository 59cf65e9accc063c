"""The block form: a JSON header, static arrays, then equal blocks of frames, so that any frame is one Range away.

    0   8 bytes   b"CAESURA" and the version of this form, 1
    8   uint32    n, length of the header; all numbers are little-endian
    12  n bytes   JSON, padded with spaces so that what follows starts at a multiple of 8
    …             the arrays, each at the `offset` its entry names, padded with zeros to a multiple of 8
    …             block 0, block 1, … : `frames_per_block` frames each, the last as many as are left

The header's `blocks` is the index: frame f starts at `offset` + f · `frame_bytes`. Blocks are not compressed, so
a reader may ask for a single frame as well as for a block.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

MAGIC = b"CAESURA\x01"
FRAMES_PER_BLOCK = 32
ALIGNMENT = 8
TYPES = {"<u4": "uint32", "<u2": "uint16", "<i2": "int16", "|u1": "uint8"}


def write_block_file(
    facts: Mapping[str, Any],
    arrays: Mapping[str, np.ndarray],
    frames: int,
    frame_bytes: int,
    blocks: Iterable[np.ndarray],
) -> Iterator[bytes]:
    """The file, piece by piece: `facts` go into the header, `blocks` are the values of `FRAMES_PER_BLOCK` frames each.

    Holds one block at a time.
    """
    yield _prologue(facts, arrays, frames, frame_bytes)
    for array in arrays.values():
        data = array.tobytes()
        yield data + bytes(-len(data) % ALIGNMENT)
    for block in blocks:
        yield block.tobytes()


def _prologue(facts: Mapping[str, Any], arrays: Mapping[str, np.ndarray], frames: int, frame_bytes: int) -> bytes:
    """Magic, length and header. Offsets depend on the header's own length, so room is made until it fits."""
    before = len(MAGIC) + 4
    room = 0
    while True:
        header = _header({**facts, "frames": frames}, arrays, frame_bytes, before + room)
        if len(header) <= room:
            return MAGIC + room.to_bytes(4, "little") + header.ljust(room)
        room = _aligned(before + len(header)) - before


def _header(facts: Mapping[str, Any], arrays: Mapping[str, np.ndarray], frame_bytes: int, offset: int) -> bytes:
    entries = {}
    for name, array in arrays.items():
        entries[name] = {"type": TYPES[array.dtype.str], "shape": list(array.shape), "offset": offset}
        offset += _aligned(array.nbytes)
    blocks = {"offset": offset, "frame_bytes": frame_bytes, "frames_per_block": FRAMES_PER_BLOCK}
    return json.dumps({**facts, "arrays": entries, "blocks": blocks}).encode()


def _aligned(size: int) -> int:
    return -(-size // ALIGNMENT) * ALIGNMENT
