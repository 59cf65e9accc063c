"""Readers that do what no reader should, for the process in which they run."""

import ctypes
import os
import socket
import subprocess
import sys
import time
from pathlib import Path

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.native.reader_answer import GlbAnswer
from caesura.formats.notices import Notices

BROKEN_OUT = Path("/tmp/caesura-break-out")


def echo(path: str, limits: Limits, notices: Notices) -> GlbAnswer:
    """The file itself."""
    print("a library that is talkative")
    os.write(1, b"and writes past Python")
    notices.add("said", f"{limits.max_vertices} vertices are allowed.")
    return GlbAnswer(Path(path).read_bytes())


def refuse(path: str, *_: object) -> GlbAnswer:
    raise InvalidModel("no-mesh", "There is nothing in it.", frame=3)


def stumble(*_: object) -> GlbAnswer:
    return GlbAnswer(None.glb)  # type: ignore[attr-defined]


def crash(*_: object) -> GlbAnswer:
    ctypes.string_at(0)
    raise AssertionError


def abort(*_: object) -> GlbAnswer:
    os.abort()


def compute_for_ever(*_: object) -> GlbAnswer:
    while True:
        pass


def wait_for_ever(*_: object) -> GlbAnswer:
    time.sleep(1000)
    raise AssertionError


def take_all_memory(*_: object) -> GlbAnswer:
    held = []
    while True:
        held.append(bytearray(2**24))


def leave_early(*_: object) -> GlbAnswer:
    os._exit(0)


def say_nonsense(*_: object) -> GlbAnswer:
    for descriptor in range(3, 30):  # the pipe of the answer is one of them
        try:
            os.write(descriptor, bytes([7]) * 64)
        except OSError:
            continue
    os._exit(0)


def _tried(what: object) -> str:
    try:
        what()  # type: ignore[operator]
    except OSError as refused:
        return type(refused).__name__
    return "done"


def break_out(path: str, limits: Limits, notices: Notices) -> GlbAnswer:
    """Note what each attempt came to."""
    outside = os.environ["PATH"].split(os.pathsep)[0]
    attempts = {
        "socket": lambda: socket.socket(socket.AF_UNIX).close(),
        "program": lambda: subprocess.run([sys.executable, "-c", ""], check=True),
        "native-program": lambda: _native("execv", b"/bin/true", None),
        "native-socket": lambda: _native("socket", 2, 1, 0),
        "native-process": lambda: _native("fork"),
        "read": lambda: Path("/etc/passwd").read_bytes(),
        "native-read": lambda: _native("open", b"/etc/passwd", 0),
        "list": lambda: list(Path("/etc").iterdir()),
        "write": lambda: BROKEN_OUT.write_bytes(b"x"),
        "native-write": lambda: _native("creat", bytes(BROKEN_OUT), 0o600),
        "delete": lambda: Path(outside, "nothing").unlink(),
        "many-files": lambda: [os.dup(2) for _ in range(1000)],
        "kill": lambda: os.kill(os.getppid(), 0),
    }
    for name, what in attempts.items():
        notices.add(name, _tried(what))
    return GlbAnswer(b"")


def _native(name: str, *arguments: object) -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    result = getattr(libc, name)(*arguments)
    if result < 0:
        raise OSError(ctypes.get_errno(), name)
    if name == "fork" and result == 0:
        os._exit(0)
