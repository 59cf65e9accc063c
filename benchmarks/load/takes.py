"""Takes to post: the same motion in as many different files as are wanted."""

import json
import struct
from collections.abc import Iterator
from itertools import count
from typing import Any

HEADER, CHUNK = 12, 8


def different(glb: bytes) -> Iterator[bytes]:
    """The same GLB again and again, each time with another number in its `asset.extras`: every one is a new file."""
    document, rest = taken_apart(glb)
    for number in count():
        document["asset"]["extras"] = {"number": number}
        yield put_together(document, rest)


def taken_apart(glb: bytes) -> tuple[dict[str, Any], bytes]:
    """The JSON of a GLB, and what follows it."""
    (length,) = struct.unpack_from("<I", glb, HEADER)
    return json.loads(glb[HEADER + CHUNK : HEADER + CHUNK + length]), glb[HEADER + CHUNK + length :]


def put_together(document: dict[str, Any], rest: bytes) -> bytes:
    """A GLB of these."""
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    size = HEADER + CHUNK + len(text) + len(rest)
    return struct.pack("<4sIII4s", b"glTF", 2, size, len(text), b"JSON") + text + rest
