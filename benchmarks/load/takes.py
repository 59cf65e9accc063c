"""Takes to post: the same motion in as many different files as are wanted."""

import json
import struct
from collections.abc import Iterator
from itertools import count

HEADER, CHUNK = 12, 8


def different(glb: bytes) -> Iterator[bytes]:
    """The same GLB again and again, each time with another number in its `asset.extras`: every one is a new file."""
    (length,) = struct.unpack_from("<I", glb, HEADER)
    document = json.loads(glb[HEADER + CHUNK : HEADER + CHUNK + length])
    rest = glb[HEADER + CHUNK + length :]
    for number in count():
        document["asset"]["extras"] = {"number": number}
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        size = HEADER + CHUNK + len(text) + len(rest)
        yield struct.pack("<4sIII4s", b"glTF", 2, size, len(text), b"JSON") + text + rest
