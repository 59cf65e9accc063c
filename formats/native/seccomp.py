"""No network and no other process, enforced by Linux: a filter of the calls that a process makes to the kernel.

The filter is a program of the kernel's packet filter that looks at each call's number; see seccomp(2). It needs no
rights, and lasts as long as the process.
"""

import ctypes
import errno
import platform

PR_SET_NO_NEW_PRIVS, PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 38, 22, 2
LOAD, JUMP_EQUAL, JUMP_FROM, JUMP_BITS, RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
ALLOW, REFUSE, KILL = 0x7FFF0000, 0x00050000, 0x80000000
NUMBER, ARCHITECTURE, FIRST_ARGUMENT = 0, 4, 16  # places in the data of a call
X32_CALLS = 0x40000000  # a second numbering of the same calls
CLONE_THREAD = 0x10000

ARCHITECTURES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}

REFUSED = {
    "x86_64": (
        *(41, 42, 43, 44, 46, 49, 50, 53, 288),  # socket, connect, accept, send, bind, listen, socketpair
        *(57, 58, 59, 322),  # fork, vfork, execve, execveat
        *(62, 101, 200, 310, 311, 424, 434),  # kill, ptrace, and reading or writing the memory of others
        425,  # io_uring_setup, which would make other calls past this filter
    ),
    "aarch64": (
        *(198, 199, 200, 201, 202, 203, 206, 211, 242),
        *(221, 281),
        *(117, 129, 130, 270, 271, 424, 434),
        425,
    ),
}
CLONE = {"x86_64": 56, "aarch64": 220}
CLONE3 = 435  # its flags lie in memory, where a filter cannot look: glibc takes `clone` where this one is missing


class _Instruction(ctypes.Structure):
    _fields_ = (("code", ctypes.c_uint16), ("yes", ctypes.c_uint8), ("no", ctypes.c_uint8), ("k", ctypes.c_uint32))


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_uint16), ("instructions", ctypes.POINTER(_Instruction)))


def refuse_network_and_processes() -> bool:
    """From now on, this process and its threads; whether the system can."""
    machine = platform.machine()
    if platform.system() != "Linux" or machine not in ARCHITECTURES:
        return False
    rows = _filter(machine)
    program = _Program(len(rows), (_Instruction * len(rows))(*rows))
    prctl = ctypes.CDLL(None, use_errno=True).prctl
    unused = (ctypes.c_ulong(0),) * 2
    if prctl(PR_SET_NO_NEW_PRIVS, ctypes.c_ulong(1), ctypes.c_ulong(0), *unused):
        return False
    return not prctl(PR_SET_SECCOMP, ctypes.c_ulong(SECCOMP_MODE_FILTER), ctypes.byref(program), *unused)


def _filter(machine: str) -> list[_Instruction]:
    """A jump skips so many of the instructions that follow."""
    rows = [
        _Instruction(LOAD, 0, 0, ARCHITECTURE),
        _Instruction(JUMP_EQUAL, 1, 0, ARCHITECTURES[machine]),
        _Instruction(RETURN, 0, 0, KILL),
        _Instruction(LOAD, 0, 0, NUMBER),
        _Instruction(JUMP_FROM, 0, 1, X32_CALLS),
        _Instruction(RETURN, 0, 0, REFUSE | errno.EPERM),
        _Instruction(JUMP_EQUAL, 0, 1, CLONE3),
        _Instruction(RETURN, 0, 0, REFUSE | errno.ENOSYS),
    ]
    for call in REFUSED[machine]:
        rows += [_Instruction(JUMP_EQUAL, 0, 1, call), _Instruction(RETURN, 0, 0, REFUSE | errno.EPERM)]
    return [
        *rows,
        _Instruction(JUMP_EQUAL, 0, 3, CLONE[machine]),
        _Instruction(LOAD, 0, 0, FIRST_ARGUMENT),
        _Instruction(JUMP_BITS, 1, 0, CLONE_THREAD),
        _Instruction(RETURN, 0, 0, REFUSE | errno.EPERM),
        _Instruction(RETURN, 0, 0, ALLOW),
    ]
