"""What a reader's process may not do: its limits, and no network, no other file, no other program.

Limits hold on every system that has `resource`; of memory, on Linux alone. Landlock and seccomp hold where Linux has
them; elsewhere an audit hook refuses the same of Python, and a fault in a library is bounded by what its user may do.
"""

import ctypes
import os
import signal
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

from caesura.core.limits import UNLIMITED, Limits
from caesura.formats.native.landlock import allow_reading_only
from caesura.formats.native.seccomp import refuse_network_and_processes

OPEN_FILES = 64
PR_SET_PDEATHSIG = 1
REFUSED_EVENTS = ("socket.", "subprocess.", "os.system", "os.exec", "os.fork", "os.spawn", "os.posix_spawn")
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


def end_with_parent(parent: int) -> None:
    """Let the system end this process when the thread that made it ends; on Linux."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:  # it ended before the call
            os.kill(os.getpid(), signal.SIGKILL)


def limit_time(limits: Limits) -> None:
    """End this process after so much processor time."""
    _lower("RLIMIT_CPU", limits.max_reader_seconds)
    _lower("RLIMIT_CORE", 0)


def confine(input_file: int | None, limits: Limits) -> None:
    """Bound memory and files, and refuse the rest, from now on: what has to be loaded has been."""
    _lower("RLIMIT_AS", _address_space() + limits.max_reader_bytes)
    _lower("RLIMIT_NOFILE", OPEN_FILES)
    _lower("RLIMIT_FSIZE", 0)
    if input_file is not None:
        allow_reading_only(input_file, _library_folders())
    refuse_network_and_processes()
    sys.addaudithook(_refuse)


def _library_folders() -> list[str]:
    """Where libraries lie that one loads at its first use, and what they ask of the machine."""
    return [*sys.path, sys.prefix, sys.base_prefix, "/usr/lib", "/usr/lib64", "/lib", "/lib64", "/sys/devices/system"]


def _lower(name: str, soft: float) -> None:
    """Set a soft limit, within the hard one; where the system has no such limit, nothing."""
    if soft >= UNLIMITED:
        return
    with suppress(ImportError, AttributeError, OSError, ValueError):
        import resource  # noqa: PLC0415  Windows has none

        hard = resource.getrlimit(getattr(resource, name))[1]
        within = int(soft) if hard == resource.RLIM_INFINITY else min(int(soft), hard)
        resource.setrlimit(getattr(resource, name), (within, hard))


def _address_space() -> int:
    """Bytes of address space in use; where the system does not tell, as on macOS, no limit of it holds."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[0])
    except OSError:
        return UNLIMITED
    return pages * os.sysconf("SC_PAGE_SIZE")


def _refuse(event: str, arguments: tuple[Any, ...]) -> None:
    """An audit hook: what is refused raises in the call that it was asked by."""
    writes = event == "open" and isinstance(arguments[2], int) and arguments[2] & WRITING
    if writes or event.startswith(REFUSED_EVENTS):
        raise PermissionError(f"{event} is not for a reader")
