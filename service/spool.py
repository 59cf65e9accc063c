"""A file on its way in: written, counted, hashed and synced in the data folder, so that keeping it is a rename."""

import hashlib
import os
import secrets
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Part:
    """One file of an upload, whole and on disk. `sha256` is hexadecimal."""

    name: str
    path: Path
    bytes: int
    sha256: str


class SpoolFile:
    """One file being received. Blocking calls: run them on a thread."""

    def __init__(self, folder: Path, name: str) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.name = name
        self.path = folder / f"{secrets.token_hex(16)}.part"
        self._file = self.path.open("xb", buffering=0)
        self._digest = hashlib.sha256()
        self._bytes = 0

    def write(self, data: bytes | memoryview) -> None:
        """Append `data`, however many calls of the system that takes."""
        self._digest.update(data)
        self._bytes += len(data)
        rest = memoryview(data)
        while rest:
            rest = rest[self._file.write(rest) :]

    def finish(self) -> Part:
        """The file, safe on disk."""
        os.fsync(self._file.fileno())
        self._file.close()
        return Part(self.name, self.path, self._bytes, self._digest.hexdigest())

    def discard(self) -> None:
        """As if it had never come."""
        self._file.close()
        self.path.unlink(missing_ok=True)
