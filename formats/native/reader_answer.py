"""What a reader answers: a GLB, frames of vertices, or texts; and how that goes through a pipe.

Every message is its length, whether it is JSON, and its bytes. The first is JSON and says what follows; where bytes
are expected, JSON is a problem that ends the answer.
"""

import json
import struct
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from caesura.core.segmentation_document import Notice

HEAD = struct.Struct("<Q?")

Write = Callable[[bytes | memoryview], object]


@dataclass(frozen=True)
class GlbAnswer:
    """A file that was read as glTF."""

    glb: bytes


@dataclass(frozen=True)
class VerticesAnswer:
    """A mesh whose vertices are stored for every frame: `blocks` of them, in order, `frames` in all."""

    triangles: Int[np.ndarray, "T 3"]
    vertices: int
    frames: int
    rate: float
    blocks: Iterable[Float[np.ndarray, "block V 3"]]


@dataclass(frozen=True)
class TextsAnswer:
    """`count` files that were written, made one after the other; each has its length before it."""

    count: int
    texts: Iterable[bytes]


Answer = GlbAnswer | VerticesAnswer | TextsAnswer


def write_answer(answer: Answer, notices: Iterable[Notice], write: Write) -> None:
    """Write all of it; what is stored by blocks is read meanwhile."""
    noted = [notice.model_dump() for notice in notices]
    if isinstance(answer, GlbAnswer):
        write_json({"glb": len(answer.glb), "notices": noted}, write)
        _write_bytes(memoryview(answer.glb), write)
        return
    if isinstance(answer, TextsAnswer):
        write_json({"texts": answer.count, "notices": noted}, write)
        for text in answer.texts:
            write_json({"bytes": len(text)}, write)
            _write_bytes(memoryview(text), write)
        return
    said = {"frames": answer.frames, "vertices": answer.vertices, "rate": answer.rate}
    write_json({**said, "triangles": len(answer.triangles), "notices": noted}, write)
    _write_bytes(np.ascontiguousarray(answer.triangles, np.int64).data, write)
    for block in answer.blocks:
        _write_bytes(np.ascontiguousarray(block, np.float32).data, write)


def write_json(value: Mapping[str, Any], write: Write) -> None:
    """Write what comes first, or the problem that ends the answer."""
    data = json.dumps(value).encode()
    write(HEAD.pack(len(data), True))
    write(data)


def _write_bytes(data: memoryview, write: Write) -> None:
    write(HEAD.pack(data.nbytes, False))
    write(data)
