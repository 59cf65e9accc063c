"""Files as buffers: an upload's parts, and scratch space that is gone when the job is."""

import mmap
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from caesura.worker.records.schema import Part
from caesura.worker.store.blobs import Blobs
from caesura.worker.store.disk_space import check_disk_space

GrantMemory = Callable[[int], None]


@contextmanager
def map_parts(blobs: Blobs, parts: Iterable[Part], grant: GrantMemory) -> Iterator[dict[str, memoryview]]:
    """The parts by name, read-only, mapped from their files. A part of no bytes is an empty buffer."""
    with ExitStack() as stack:
        yield {part.name: _map_file(stack.enter_context(blobs.path(part.key)), grant) for part in parts}


def scratch_space(folder: Path, grant: GrantMemory, stays_free: int | None = None) -> Callable[[int], memoryview]:
    """What hands out writable buffers of so many bytes, each a file without a name in `folder`.

    The disk is reserved at once: a full one is an OSError here and not a bus error on some later write. Raises
    `StorageFull` where fewer than `stays_free` bytes of it would be left.
    """

    def scratch(size: int) -> memoryview:
        if size == 0:
            return memoryview(bytearray())
        if stays_free is not None:
            check_disk_space(folder, size, stays_free)
        with tempfile.TemporaryFile(dir=folder) as file:
            if hasattr(os, "posix_fallocate"):
                os.posix_fallocate(file.fileno(), 0, size)
            else:
                file.truncate(size)
            grant(size)
            return memoryview(mmap.mmap(file.fileno(), size))

    return scratch


def _map_file(path: Path, grant: GrantMemory) -> memoryview:
    with path.open("rb") as file:
        size = os.fstat(file.fileno()).st_size
        if size == 0:
            return memoryview(b"")
        grant(size)
        return memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
