"""Files mapped into memory: core reads buffers and opens nothing itself."""

import mmap
import os
import tempfile
from pathlib import Path


def map_file(path: Path) -> memoryview:
    """The file's bytes, mapped read-only: only what is looked at is read."""
    with path.open("rb") as file:
        if not path.stat().st_size:
            return memoryview(b"")  # nothing to map
        return memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))


def scratch_buffer(size: int) -> memoryview:
    """`size` writable bytes on disk, in a file without a name: gone with the process, however it ends.

    The disk is reserved at once: a full one is an OSError here and not a bus error at some later write.
    """
    with tempfile.TemporaryFile(prefix="caesura-") as file:
        try:
            if hasattr(os, "posix_fallocate"):
                os.posix_fallocate(file.fileno(), 0, max(size, 1))
            else:
                file.truncate(max(size, 1))
        except OSError as full:
            folder = tempfile.gettempdir()
            detail = f"{folder} has no room for {size} temporary bytes ({full.strerror}); TMPDIR names another folder"
            raise OSError(full.errno, detail) from full
        return memoryview(mmap.mmap(file.fileno(), max(size, 1)))[:size]
