"""What one job may use of the machine. Set in the work-horse, so a job that takes too much ends alone.

Memory: what the process has at the start, `job_memory_bytes`, and the files it maps; over it, Python raises
MemoryError. Processor time: threads x seconds; over it, the kernel sends SIGXCPU. Wall time is RQ's job timeout.
"""

import resource
from pathlib import Path

GRACE_SECONDS = 60


class JobQuota:
    """The limits of this process, from now on."""

    def __init__(self, memory_bytes: int, processor_seconds: int) -> None:
        self._bytes = _address_space() + memory_bytes
        used = resource.getrusage(resource.RUSAGE_SELF)
        spent = int(used.ru_utime + used.ru_stime)
        _lower(resource.RLIMIT_CPU, spent + processor_seconds + GRACE_SECONDS)
        _lower(resource.RLIMIT_AS, self._bytes)

    def extend(self, mapped_bytes: int) -> None:
        """Make room for a file that is about to be mapped: its pages are the system's to drop."""
        self._bytes += mapped_bytes
        _lower(resource.RLIMIT_AS, self._bytes)


def _lower(what: int, soft: int) -> None:
    """Set the soft limit, within the hard one, which only the machine's keeper sets."""
    hard = resource.getrlimit(what)[1]
    resource.setrlimit(what, (soft if hard == resource.RLIM_INFINITY else min(soft, hard), hard))


def resident_bytes() -> int:
    """Bytes of memory in use by this process; where the system does not tell, none."""
    return _pages(1)


def _address_space() -> int:
    """Bytes of address space in use; where the system does not tell, none."""
    return _pages(0)


def _pages(field: int) -> int:
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[field])
    except OSError:
        return 0
    return pages * resource.getpagesize()
