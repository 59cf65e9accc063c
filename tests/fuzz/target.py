"""What the fuzzer does with a file: reads its header, takes and animation, draws frames; takes JSON for a request,
and text for labels."""

import io
import time
import zlib

from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.read import list_takes, read_animation
from caesura.formats.upload_summary import read_header
from tests.fuzz.bodies import attempt_bodies
from tests.fuzz.labels import attempt_labels
from tests.fuzz.parts import parted

LIMITS = Limits(
    max_decoded_bytes=2**26,
    max_inflated_bytes=2**26,
    max_vertices=50_000,
    max_triangles=50_000,
    max_target_vertices=2_000_000,
    max_nodes=5_000,
)
"""A sixteenth of what a service allows, so that a file at a limit takes a sixteenth of the time."""

LONGEST_SECONDS = 2.0
"""Processor seconds for one file; more is a hang. Not the clock's: a busy machine is no hang of ours."""

MOST_DRAWN = 2_000_000
"""Coordinates of the frames that are drawn at a time."""

NATIVE = {"fbx", "abc", "usd"}
"""Formats that are read by libraries of native code, of which the headers alone are ours."""

ASKED = (
    {},
    {"take": 0, "fps": 30},
    {"take": "all"},
    {"trim": True, "fps": 24},
    {"start": 0.25, "end": 0.75},
    {"take": 1, "fps": 1000},
    {"start": 0.5, "fps": 0.5},
)
"""Parameters that people send; which ones go with a file is told by its bytes."""


class Hang(Exception):
    """A file took longer than any may."""


def attempt(data: bytes) -> tuple[bool, float]:
    """Whether the upload `data` was read, and in how many processor seconds; it may be refused.

    Whatever else is raised is a fault of ours. What takes too long is tried once more, for the first time may be spent
    on compiling loops.
    """
    for _ in range(2):
        began = time.process_time()
        read = _attempted(data)
        if (seconds := time.process_time() - began) <= LONGEST_SECONDS:
            return read, seconds
    raise Hang(f"{seconds:.1f} processor seconds")


def _attempted(data: bytes) -> bool:
    parts = parted(data)
    asked = Parameters.parse(dict(ASKED[zlib.crc32(data) % len(ASKED)]))
    if data.lstrip()[:1] in {b"{", b"["}:
        for refused in attempt_bodies(data):
            _told(refused)
    if b"\0" not in data[:SIGNATURE_BYTES]:
        for refused in attempt_labels(data):
            _told(refused)
    return [_header(parts), _takes(parts), _frames(parts, asked)][-1]


def _header(parts: dict[str, bytes]) -> None:
    for name, data in parts.items():
        try:
            read_header(io.BytesIO(data), name, LIMITS)
        except CaesuraError as refused:
            _told(refused)


def _takes(parts: dict[str, bytes]) -> None:
    try:
        list_takes(parts, LIMITS)
    except CaesuraError as refused:
        _told(refused)


def _frames(parts: dict[str, bytes], asked: Parameters) -> bool:
    try:
        if any(detect_file_type(data[:SIGNATURE_BYTES]) in NATIVE for data in parts.values()):
            return False  # each would be a process: tests.fuzz.native
        animation = read_animation(parts, asked, LIMITS, lambda size: memoryview(bytearray(size)))
        block = min(max(MOST_DRAWN // (3 * animation.vertex_count), 1), 3)
        for first in {0, animation.frames // 2, max(animation.frames - block, 0)}:
            animation.vertices(first, min(first + block, animation.frames))
    except CaesuraError as refused:
        _told(refused)
        return False
    return True


def _told(refused: CaesuraError) -> None:
    """A refusal must have a code and a sentence that can be sent."""
    problem = refused.problem()
    if not problem["code"] or not problem["detail"].encode():
        raise AssertionError(problem)
