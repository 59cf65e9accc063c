"""Files as memory: core reads buffers and opens nothing itself."""

import mmap
import tempfile
from pathlib import Path


def mapped(path: Path) -> memoryview:
    """The file's bytes, mapped read-only: only what is looked at is read."""
    with path.open("rb") as file:
        if not path.stat().st_size:
            return memoryview(b"")  # nothing to map
        return memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))


def scratch(size: int) -> memoryview:
    """`size` writable bytes on disk, in a file without a name: gone with the process, however it ends."""
    with tempfile.TemporaryFile(prefix="caesura-") as file:
        file.truncate(max(size, 1))
        return memoryview(mmap.mmap(file.fileno(), max(size, 1)))[:size]
