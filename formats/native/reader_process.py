"""A process that reads one file with a library of native code, as the process that starts it sees it."""

import importlib.util
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
from collections import deque
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from io import FileIO
from typing import IO, Any, Self, cast

from caesura.core.errors import BrokenContainer, CaesuraError, LimitExceeded, UnsupportedMedia, error_from_problem
from caesura.core.limits import UNLIMITED, Limits
from caesura.formats.native.reader_answer import HEAD
from caesura.formats.native.reader_main import FAULT, memory_problem

LONGEST_MESSAGE = 2**20
"""Bytes of JSON that a process is believed."""

LAST_WORDS = 8000
"""Bytes of what a process printed that are kept."""

PIECE = 2**20
KEPT_VARIABLES = ("LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH", "PATH", "SYSTEMROOT", "TMPDIR")


@dataclass(frozen=True)
class NativeReader:
    """A reader: the title of its format, its module, the place of its function, and the extra that brings it."""

    title: str
    module: str
    place: str
    extra: str = ""

    def require_library(self) -> None:
        """Raise `UnsupportedMedia("reader-missing")` where the library is not installed."""
        if importlib.util.find_spec(self.module) is None:
            advice = f"Install caesura[{self.extra}], or export" if self.extra else "Export"
            raise UnsupportedMedia(
                "reader-missing",
                f"{self.title} is read by {self.module}, which is not installed here. {advice} the file as GLB.",
            )


class ReaderProcess:
    """Reads `data` in a fresh process, while the context is open; whatever of it is left then is ended.

    `arguments` go to the reader's function by their names.

    Raises what the reader refuses; `BrokenContainer("reader-crashed")` or `LimitExceeded` for what ended the process;
    and `RuntimeError` where that is a fault of ours.
    """

    def __init__(
        self, reader: NativeReader, data: memoryview, limits: Limits, arguments: Mapping[str, Any] | None = None
    ) -> None:
        self.reader = reader
        self._data = data
        self._limits = limits
        self._arguments = arguments or {}
        self._late = False
        self._printed: deque[bytes] = deque(maxlen=LAST_WORDS // 100)
        self._opened = ExitStack()

    def __enter__(self) -> Self:
        self.reader.require_library()
        with ExitStack() as opened:
            file = opened.enter_context(_temporary_copy(self._data))
            self._process = opened.enter_context(_start(self.reader, file, self._limits, self._arguments))
            self._listener = threading.Thread(target=self._listen, daemon=True)
            self._listener.start()
            opened.callback(self._listener.join)
            opened.callback(self._process.kill)
            if self._limits.max_reader_seconds < UNLIMITED:  # of the clock: it may wait and not compute
                timer = threading.Timer(2 * self._limits.max_reader_seconds, self._end_late)
                timer.daemon = True
                timer.start()
                opened.callback(timer.cancel)
            self._opened = opened.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._opened.close()

    def receive(self) -> dict[str, Any]:
        """What the answer says first."""
        length, is_json = self._head()
        if not is_json:
            raise self._fault("bytes where JSON belongs")
        said = self._json(length)
        if "code" in said:
            raise self._problem(said)
        return said

    def fill(self, room: memoryview) -> None:
        """Fill `room` with bytes that follow."""
        rest = room.cast("B")
        while rest:
            length, is_json = self._head()
            if is_json:
                raise self._problem(self._json(length))
            if length > len(rest):
                raise self._fault(f"{length} bytes for {len(rest)}")
            self._read(rest[:length])
            rest = rest[length:]

    def _head(self) -> tuple[int, bool]:
        head = bytearray(HEAD.size)
        self._read(memoryview(head))
        return HEAD.unpack(head)

    def _json(self, length: int) -> dict[str, Any]:
        if length > LONGEST_MESSAGE:
            raise self._fault(f"{length} bytes of JSON")
        data = bytearray(length)
        self._read(memoryview(data))
        said: dict[str, Any] = json.loads(data)
        return said

    def _read(self, room: memoryview) -> None:
        while room:
            count = cast("FileIO", self._process.stdout).readinto(room[:PIECE])
            if not count:
                raise self._ending()
            room = room[count:]

    def _listen(self) -> None:
        for piece in iter(partial(cast("FileIO", self._process.stderr).read, 100), b""):
            self._printed.append(piece)

    def _end_late(self) -> None:
        self._late = True
        self._process.kill()

    def _ending(self) -> Exception:
        """Why the process ended before its answer was complete."""
        status = self._process.wait()
        self._listener.join(1)
        printed = b"".join(self._printed)
        if status in {0, FAULT}:
            return self._fault("it ended early")
        if self._late or status == -getattr(signal, "SIGXCPU", 0):
            return _time_problem(self.reader.title, self._limits)
        if b"bad_alloc" in printed or status == -getattr(signal, "SIGKILL", 0):  # by the system, for want of memory
            return memory_problem(self.reader.title, self._limits)
        return BrokenContainer(
            "reader-crashed",
            f"The {self.reader.title} is damaged: the library that reads it ended with {_name(status)}. Export the "
            "file again, or as GLB.",
        )

    def _problem(self, said: dict[str, Any]) -> Exception:
        try:
            return error_from_problem(said)
        except (KeyError, TypeError):
            return self._fault(f"no problem: {str(said)[:200]}")

    def _fault(self, what: str) -> Exception:
        printed = b"".join(self._printed).decode(errors="replace")
        return RuntimeError(f"the process that reads {self.reader.title} answered wrongly: {what}\n{printed}")


def _temporary_copy(data: memoryview) -> IO[bytes]:
    """The file, where a process of another program can open it; gone with the descriptor, but on Windows."""
    file = tempfile.NamedTemporaryFile(prefix="caesura-") if os.name == "nt" else tempfile.TemporaryFile()  # noqa: SIM115
    file.write(data)
    file.flush()
    return file


def _start(
    reader: NativeReader, file: IO[bytes], limits: Limits, arguments: Mapping[str, Any]
) -> subprocess.Popen[bytes]:
    descriptor = None if os.name == "nt" else file.fileno()
    request = {
        "title": reader.title,
        "place": reader.place,
        "path": file.name if descriptor is None else f"/dev/fd/{descriptor}",
        "descriptor": descriptor,
        "parent": os.getpid(),
        "limits": limits.model_dump(include=set(Limits.model_fields)),
        "arguments": dict(arguments),
    }
    kept = {name: os.environ[name] for name in KEPT_VARIABLES if name in os.environ}
    return subprocess.Popen(  # noqa: S603  our own interpreter, and arguments of ours
        [sys.executable, "-P", "-s", "-m", "caesura.formats.native.reader_main", json.dumps(request)],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        bufsize=0,
        pass_fds=() if descriptor is None else (descriptor,),
        env={**kept, "PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": "1"},
    )


def _time_problem(title: str, limits: Limits) -> CaesuraError:
    return LimitExceeded(
        "limit-exceeded",
        f"To read this {title} takes more than {limits.max_reader_seconds:,} seconds. Send a shorter take or a "
        "smaller model, or ask the operator of this service to raise CAESURA_MAX_READER_SECONDS.",
        limit=limits.max_reader_seconds,
        setting="CAESURA_MAX_READER_SECONDS",
    )


def _name(status: int) -> str:
    try:
        return signal.Signals(-status).name
    except ValueError:
        return f"status {status}"
