"""Files on their way: written aside, held by a lock as long as somebody writes them, and cleared once nobody does.

A process that is killed leaves its file behind, but not its lock: the system gives that back. So a file that can be
locked is nobody's, whatever the clock says and whichever container wrote it.
"""

import fcntl
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import FileIO
from pathlib import Path

SUFFIX = ".part"


def locked_temporary_file(folder: Path) -> FileIO:
    """A new file in a folder, open for reading and writing, held until it is closed."""
    folder.mkdir(parents=True, exist_ok=True)
    while True:
        file = FileIO(folder / f"{secrets.token_hex(16)}{SUFFIX}", "x+b")
        fcntl.flock(file, fcntl.LOCK_EX)
        if os.fstat(file.fileno()).st_nlink:
            return file
        file.close()  # cleared in the moment before it was held


@contextmanager
def temporary_file(folder: Path) -> Iterator[FileIO]:
    """A held file that is gone afterwards, unless it was moved to its place."""
    with locked_temporary_file(folder) as file:
        try:
            yield file
        finally:
            file_path(file).unlink(missing_ok=True)


def file_path(file: FileIO) -> Path:
    """Where a held file is."""
    return Path(os.fsdecode(file.name))


def delete_abandoned_files(folder: Path) -> int:
    """Delete the files in a folder that nobody holds; how many."""
    count = 0
    for path in folder.glob(f"*{SUFFIX}"):
        with suppress(FileNotFoundError, BlockingIOError), path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            path.unlink()
            count += 1
    return count


def write_all(file: FileIO, data: bytes | memoryview) -> None:
    """All of `data`, however many calls of the system that takes."""
    rest = memoryview(data)
    while rest:
        rest = rest[file.write(rest) :]
