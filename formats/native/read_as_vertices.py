"""A file that is read as frames of vertices, in a process of its own."""

from collections.abc import Callable
from typing import Any

import numpy as np

from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.native.reader_process import NativeReader, ReaderProcess
from caesura.formats.notices import Notices
from caesura.formats.npz.read import check_triangles, vertex_sequence_from_arrays

ADVICE = "Send a part of the take, or fewer vertices"


def read_as_vertices(
    reader: NativeReader,
    data: memoryview,
    parameters: Parameters,
    limits: Limits,
    scratch: Callable[[int], memoryview],
) -> Animation:
    """The animation of a file whose reader answers with vertices; raises as `ReaderProcess` does."""
    with ReaderProcess(reader, data, limits) as process:
        return receive_vertices(process, process.receive(), parameters, limits, scratch)


def receive_vertices(
    process: ReaderProcess,
    said: dict[str, Any],
    parameters: Parameters,
    limits: Limits,
    scratch: Callable[[int], memoryview],
) -> Animation:
    """The animation of what the process has announced, its frames in `scratch`."""
    frames, vertices, count = said["frames"], said["vertices"], said["triangles"]
    size = frames * vertices * 12
    limits.check("max_inflated_bytes", size, ADVICE)
    limits.check("max_triangles", count)
    triangles = np.empty((count, 3), np.int64)
    process.fill(triangles.data)
    room = scratch(size)
    process.fill(room)
    notices = Notices()
    for noted in said["notices"]:
        notices.add(noted["code"], noted["detail"])
    stored = np.frombuffer(room, np.float32).reshape(frames, vertices, 3)
    checked = check_triangles(triangles, vertices, notices)
    return vertex_sequence_from_arrays(stored, checked, None, said["rate"], parameters, limits, notices)
