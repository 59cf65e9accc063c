"""No file but the input and the libraries, enforced by Linux: rules of what a process may open; see landlock(7).

It needs no rights, and lasts as long as the process.
"""

import ctypes
import os
import platform
from collections.abc import Iterable

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446  # the same numbers on every architecture
VERSION, PATH_BENEATH = 1, 1
PR_SET_NO_NEW_PRIVS = 38

EXECUTE, READ_FILE, READ_FOLDER = 1 << 0, 1 << 2, 1 << 3
RIGHTS_OF_VERSION = (13, 14, 15, 15, 16, 16, 16)
"""How many rights over files versions 1, 2, … of Landlock know: bits from 0 on."""


class _Ruleset(ctypes.Structure):
    _fields_ = (("handled", ctypes.c_uint64),)


class _Rule(ctypes.Structure):
    _pack_ = 1
    _layout_ = "ms"
    _fields_ = (("allowed", ctypes.c_uint64), ("parent", ctypes.c_int32))


def allow_reading_only(input_file: int, folders: Iterable[str]) -> bool:
    """From now on this process may read the file of the descriptor `input_file` and what is in `folders`, and no more.

    Nothing may be written, made or deleted. Answers whether the system can.
    """
    version = landlock_version()
    if version < 1:
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    rights = RIGHTS_OF_VERSION[min(version, len(RIGHTS_OF_VERSION)) - 1]
    handled = _Ruleset((1 << rights) - 1)
    ruleset = libc.syscall(CREATE_RULESET, ctypes.byref(handled), ctypes.c_size_t(8), ctypes.c_uint32(0))
    if ruleset < 0:
        return False

    def allow(descriptor: int, allowed: int) -> None:
        rule = _Rule(allowed, descriptor)
        libc.syscall(ADD_RULE, ruleset, ctypes.c_int(PATH_BENEATH), ctypes.byref(rule), ctypes.c_uint32(0))

    try:
        allow(input_file, READ_FILE)
        for folder in folders:
            opened = _open_path(folder)
            if opened is not None:
                allow(opened, EXECUTE | READ_FILE | READ_FOLDER)
                os.close(opened)
        libc.prctl(PR_SET_NO_NEW_PRIVS, *map(ctypes.c_ulong, (1, 0, 0, 0)))
        return not libc.syscall(RESTRICT_SELF, ruleset, ctypes.c_uint32(0))
    finally:
        os.close(ruleset)


def landlock_version() -> int:
    """The version that this system has; less than 1 where it has none."""
    if platform.system() != "Linux":
        return 0
    return int(ctypes.CDLL(None).syscall(CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(VERSION)))


def _open_path(folder: str) -> int | None:
    try:
        return os.open(folder, os.O_PATH | os.O_CLOEXEC | os.O_DIRECTORY)
    except OSError:
        return None
