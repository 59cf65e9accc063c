"""A small disk of its own for a service under test, which can be filled to the last byte and emptied again."""

import errno
import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

SMALLEST_FILE = 4096


class SmallDisk:
    """A file system in memory at `folder`."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._ballast = folder / "ballast"

    @property
    def free(self) -> int:
        """Bytes that can still be written."""
        disk = os.statvfs(self.folder)
        return disk.f_bavail * disk.f_frsize

    @property
    def full(self) -> bool:
        """Whether it was filled, and not emptied since."""
        return self._ballast.exists()

    def fill(self) -> None:
        """Take all bytes that are free, though others may write meanwhile."""
        with self._ballast.open("ab") as ballast:
            while (free := self.free) >= SMALLEST_FILE:
                try:
                    os.posix_fallocate(ballast.fileno(), ballast.seek(0, os.SEEK_END), max(free // 2, SMALLEST_FILE))
                except OSError as refused:
                    if refused.errno != errno.ENOSPC:
                        raise

    def empty(self) -> None:
        """Give them back."""
        self._ballast.unlink(missing_ok=True)


@contextmanager
def small_disk(folder: Path, size_bytes: int) -> Iterator[SmallDisk]:
    """Mount one, until the block ends. Raises PermissionError where this system does not allow it."""
    folder.mkdir(parents=True, exist_ok=True)
    command = ["mount", "-t", "tmpfs", "-o", f"size={size_bytes}", "tmpfs", str(folder)]
    if subprocess.run(command, capture_output=True, check=False).returncode:
        raise PermissionError("no file system can be mounted here")
    try:
        yield SmallDisk(folder)
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)
