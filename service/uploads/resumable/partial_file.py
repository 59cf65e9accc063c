"""A file that has come in part. Its length on disk is the offset: what was acknowledged is there, whatever ends."""

import fcntl
import hashlib
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import FileIO
from pathlib import Path

from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.store.temporary_files import write_all

HASHED_BYTES = 2**20


class UploadBusy(RequestProblem):
    """Another request writes to this upload, or its connection broke and that is not noticed yet."""

    headers = {"Retry-After": "1"}  # noqa: RUF012  as every refusal has them, never changed


@contextmanager
def held_file(path: Path) -> Iterator[FileIO]:
    """The file, open for appending and held by this request alone; raises `UploadBusy`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with FileIO(path, "a+b") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise UploadBusy(
                "upload-busy", "Another request writes to this upload. Ask for its offset again."
            ) from None
        if not os.fstat(file.fileno()).st_nlink:  # it was ended between the two calls
            raise UploadBusy("upload-busy", "This upload has just ended. Ask for its offset again.")
        yield file


def received_bytes(path: Path) -> int:
    """How many bytes have come; 0 where none has, or they came to another machine."""
    try:
        return path.stat().st_size
    except FileNotFoundError:
        return 0


def append(file: FileIO, data: bytes) -> None:
    """The next bytes."""
    write_all(file, data)


def sync(file: FileIO) -> int:
    """Have what came safe on disk, and answer how much that is."""
    os.fsync(file.fileno())
    return os.fstat(file.fileno()).st_size


def file_digest(path: Path) -> str:
    """SHA-256 of a whole file, hexadecimal."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def delete_forgotten_files(folder: Path, is_known: Callable[[str], bool]) -> None:
    """Delete the files of uploads that nobody knows any more, and that nobody writes."""
    for path in folder.glob("*"):
        if is_known(path.name):
            continue
        with suppress(UploadBusy), held_file(path):
            path.unlink(missing_ok=True)
