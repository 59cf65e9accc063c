"""A file on its way in: written, counted, hashed and synced in the data folder, so that keeping it is a rename."""

import hashlib
import os
from dataclasses import dataclass
from pathlib import Path

from caesura.worker.store.temporary_files import file_path, locked_temporary_file, write_all


@dataclass(frozen=True)
class Part:
    """One file of an upload, whole and on disk. `sha256` is hexadecimal."""

    name: str
    path: Path
    bytes: int
    sha256: str


class SpoolFile:
    """One file being received, held until it is discarded. Blocking calls: run them on a thread."""

    def __init__(self, folder: Path, name: str) -> None:
        self.name = name
        self._file = locked_temporary_file(folder)
        self.path = file_path(self._file)
        self._digest = hashlib.sha256()
        self._bytes = 0

    def write(self, data: bytes | memoryview) -> None:
        """Append `data`."""
        self._digest.update(data)
        self._bytes += len(data)
        write_all(self._file, data)

    def finish(self) -> Part:
        """The file, safe on disk."""
        os.fsync(self._file.fileno())
        return Part(self.name, self.path, self._bytes, self._digest.hexdigest())

    def discard(self) -> None:
        """As if it had never come; what was moved to its place before stays there."""
        self.path.unlink(missing_ok=True)
        self._file.close()
