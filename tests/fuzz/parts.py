"""Several files as the bytes of one, so that an upload of many is an input like any other."""

import struct
from collections.abc import Mapping

MAGIC = b"PARTS"
LENGTH = struct.Struct("<I")


def joined(parts: Mapping[str, bytes]) -> bytes:
    """One file as it is; several behind a mark, each with its name."""
    if len(parts) == 1:
        return next(iter(parts.values()))
    pieces = (piece for name, data in parts.items() for piece in (name.encode("utf-8", "replace"), data))
    return MAGIC + b"".join(LENGTH.pack(len(piece)) + piece for piece in pieces)


def parted(data: bytes) -> dict[str, bytes]:
    """The files in `data`, however broken it is: what is cut off ends there."""
    if not data.startswith(MAGIC):
        return {"model": data}
    pieces, at = [], len(MAGIC)
    while at + LENGTH.size <= len(data) and len(pieces) < 16:
        (length,) = LENGTH.unpack_from(data, at)
        at += LENGTH.size
        pieces.append(data[at : at + length])
        at += length
    names = [name.decode("utf-8", "replace") for name in pieces[::2]]
    return dict(zip(names, pieces[1::2], strict=False)) or {"model": data}
