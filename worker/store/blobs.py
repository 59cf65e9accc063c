"""Files by key, in a local folder or an S3-compatible store: uploads, analyses, what the page plays.

Keys are random, so a key tells nothing and a blob is never written twice; the records point to them. A blob is
whole or not there: written aside, then moved to its name.
"""

import errno
import os
import re
import secrets
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from datetime import timedelta
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Literal, Self

import obstore
from obstore.exceptions import NotFoundError
from obstore.store import LocalStore, ObjectStore, from_url

from caesura.worker.store.disk_space import check_disk_space
from caesura.worker.store.temporary_files import file_path, temporary_file, write_all

if TYPE_CHECKING:  # a type alone: it is not there at run time
    from obstore.store import RetryConfig

Kind = Literal["uploads", "analyses", "viewer", "exports", "collections"]

KEY = re.compile(r"[a-z]+/[0-9a-f]{32}")
CHUNK_BYTES = 1 << 17
"""Of a local file, read at once: a client that reads slowly holds about three of them."""
SENT_BYTES, PIECE_BYTES = 1 << 20, 8 << 20
"""Asked of a remote store at once, for a client and for a copy: it must arrive within one request's time (AWS_TIMEOUT,
else 30 s)."""
SENT_AT_ONCE = 8
"""Small blobs, to a remote store."""
RETRIES: "RetryConfig" = {"max_retries": 5, "retry_timeout": timedelta(seconds=20)}
"""A store that is away for longer is told to whoever asks, who can wait better than a thread here."""


class BlobMissing(LookupError):
    """There is no blob of this key: it was deleted, or kept elsewhere."""


class Blobs:
    """One store. Safe to share between threads; the calls block, so an async caller makes them in a thread."""

    def __init__(self, store: ObjectStore, folder: Path | None, scratch: Path) -> None:
        self._store = store
        self._folder = folder
        self._scratch = scratch

    @classmethod
    def open(cls, location: str, scratch: Path) -> Self:
        """The store at a folder, or at a URL such as `s3://bucket/prefix` (credentials from the environment).

        `scratch` is a folder for what must be a file for a while. On the file system of a local store, `adopt`
        moves a file in at no cost.
        """
        scratch.mkdir(parents=True, exist_ok=True)
        if "://" in location:
            return cls(from_url(location, retry_config=RETRIES), None, scratch)
        folder = Path(location).absolute()
        return cls(LocalStore(folder, mkdir=True), folder, scratch)

    def adopt(self, path: Path, kind: Kind = "uploads") -> str:
        """Take over a local file, which must be closed and fsynced: it is moved, not copied, where that can be.

        Raises OSError or obstore's `BaseError` where the store is full or unreachable; the file then stays.
        """
        key = self._place(path, kind)
        if self._folder is not None:
            _fsync_folder(self._folder / kind)
        return key

    def put_all(self, contents: Sequence[bytes], kind: Kind) -> list[str]:
        """Keep several small ones, each as a blob of its own; the disk is waited for once."""
        if self._folder is None or not contents:
            with ThreadPoolExecutor(SENT_AT_ONCE) as pool:
                return list(pool.map(lambda content: self.put(content, kind), contents))
        keys = []
        for content in contents:
            with temporary_file(self._scratch) as file:
                write_all(file, content)
                keys.append(self._place(file_path(file), kind))
        _fsync_folder(self._folder / kind)
        return keys

    def put(self, content: bytes | memoryview | Iterator[bytes], kind: Kind, stays_free: int | None = None) -> str:
        """Keep some bytes, at once or piece by piece as they are made.

        Raises `StorageFull` where a piece would leave fewer than `stays_free` bytes of the disk of a local store.
        """
        if self._folder is None:
            key = _new_key(kind)
            obstore.put(self._store, key, content)
            return key
        with temporary_file(self._scratch) as file:
            for piece in [content] if isinstance(content, bytes | memoryview) else content:
                if stays_free is not None:
                    check_disk_space(self._scratch, len(piece), stays_free)
                write_all(file, piece)
            return self.adopt(file_path(file), kind)

    def read(self, key: str) -> bytes:
        """All bytes of a blob that is known to be small."""
        with _missing(key):
            return bytes(obstore.get(self._store, key).bytes())

    def size(self, key: str) -> int:
        """How many bytes it has."""
        with _missing(key):
            return int(obstore.head(self._store, key)["size"])

    def exists(self, key: str) -> bool:
        """Whether it is there."""
        try:
            return self.size(key) >= 0
        except BlobMissing:
            return False

    def stream(self, key: str, start: int = 0, end: int | None = None) -> Iterator[bytes]:
        """Bytes [start, end) piece by piece; a missing blob raises at this call, not at the first piece."""
        end = self.size(key) if end is None else end
        if end <= start:
            return iter(())
        if self._folder is None:
            return self._pieces(key, start, end, SENT_BYTES)
        return _read(self._existing(key).open("rb"), start, end)

    def _pieces(self, key: str, start: int, end: int, most: int) -> Iterator[bytes]:
        """A request for each piece: one for all of it would run out of time where the reader is slow."""

        def piece(first: int) -> bytes:
            with _missing(key):
                return bytes(obstore.get_range(self._store, key, start=first, end=min(first + most, end)))

        return chain([piece(start)], map(piece, range(start + most, end, most)))

    @contextmanager
    def path(self, key: str) -> Iterator[Path]:
        """The blob as a local file to read or map, never to write: the file itself where the store is a folder."""
        if self._folder is not None:
            yield self._existing(key)
            return
        with temporary_file(self._scratch) as copy:
            for piece in self._pieces(key, 0, self.size(key), PIECE_BYTES):
                write_all(copy, piece)
            yield file_path(copy)

    def delete(self, key: str) -> None:
        """Delete it; nothing happens where it is not there."""
        with suppress(BlobMissing), _missing(key):
            obstore.delete(self._store, key)

    def reach(self) -> None:
        """Ask the store for what is not there; raises OSError or obstore's `BaseError` where it does not answer."""
        with suppress(NotFoundError, FileNotFoundError):
            obstore.head(self._store, "reach")

    def all(self) -> Iterator[tuple[str, int]]:
        """Every blob, with its size in bytes; what is being written is not among them."""
        for page in obstore.list(self._store):
            yield from ((str(blob["path"]), int(blob["size"])) for blob in page)

    def _place(self, path: Path, kind: Kind) -> str:
        """Move a file to a new name, or copy it where it cannot be moved."""
        key = _new_key(kind)
        if self._folder is None or not _move(path, self._folder / key):
            obstore.put(self._store, key, path)
            path.unlink(missing_ok=True)
        return key

    def _existing(self, key: str) -> Path:
        path = (self._folder or Path()) / key
        with _missing(key):
            if not path.is_file():
                raise FileNotFoundError
        return path


def _read(file: BinaryIO, start: int, end: int) -> Iterator[bytes]:
    with file:
        file.seek(start)
        for place in range(start, end, CHUNK_BYTES):
            yield file.read(min(CHUNK_BYTES, end - place))


@contextmanager
def _missing(key: str) -> Iterator[None]:
    """obstore's word for a missing blob, as ours. Keys come from Redis: what is none leads nowhere."""
    if not KEY.fullmatch(key):
        raise BlobMissing(key)
    try:
        yield
    except (NotFoundError, FileNotFoundError) as missing:
        raise BlobMissing(key) from missing


def _new_key(kind: Kind) -> str:
    return f"{kind}/{secrets.token_hex(16)}"


def _move(path: Path, target: Path) -> bool:
    """Move a file to its name, or say that it lies on another file system."""
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        path.rename(target)
    except OSError as refused:
        if refused.errno == errno.EXDEV:
            return False
        raise
    return True


def _fsync_folder(path: Path) -> None:
    """Make the names in a folder last."""
    folder = os.open(path, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)
