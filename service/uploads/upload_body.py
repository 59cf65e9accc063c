"""Receiving files: any length, one block in memory, off the event loop, nothing left behind on failure.

A raw body, `curl --data-binary` (whatever type it claims) and a form of one part are the same upload.
"""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn, Protocol

from anyio import CancelScope, move_on_after, to_thread
from fastapi import Request

from caesura.service.backend import Backend
from caesura.service.http.file_name import disposition_name
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.uploads.multipart import MultipartBody, multipart_boundary
from caesura.service.uploads.spool import Part, SpoolFile
from caesura.worker.store.disk_space import check_disk_space

BLOCK_BYTES = 2**20
FAREWELL_SECONDS = 1.0


@dataclass(frozen=True)
class Upload:
    """What came: at least one file, and the fields of the form it came in."""

    parts: tuple[Part, ...]
    fields: dict[str, str] = field(default_factory=dict)


class UploadBody(Protocol):
    """Takes a body block by block."""

    def feed(self, block: bytes) -> None:
        """The next bytes."""

    def finish(self) -> tuple[tuple[Part, ...], dict[str, str]]:
        """The files and the fields."""

    def discard(self) -> None:
        """Delete what was received."""


class RawBody:
    """The file itself as the body."""

    def __init__(self, folder: Path, name: str) -> None:
        self._file = SpoolFile(folder, name)

    def call(self, name: str) -> None:
        """Give it a name, where it has none yet."""
        self._file.name = self._file.name or name

    def feed(self, block: bytes) -> None:
        """The next bytes of the file."""
        self._file.write(block)

    def finish(self) -> tuple[tuple[Part, ...], dict[str, str]]:
        """The file."""
        return (self._file.finish(),), {}

    def discard(self) -> None:
        """Delete what was received."""
        self._file.discard()


@asynccontextmanager
async def receive_upload(request: Request, backend: Backend) -> AsyncIterator[Upload]:
    """The upload of `request`, in the spool until the block ends; what is to stay must have been moved by then.

    Raises `StorageFull` where what is still to come would fill the disk, for others may be sending too, and
    `RequestProblem` ("not-ready") where the process is told to stop before all has come.
    """
    settings, folder = backend.settings, backend.spool
    mark = multipart_boundary(request.headers.get("content-type", ""))
    called = request.query_params.get("name") or disposition_name(request.headers.get("content-disposition", ""))
    body: UploadBody = await to_thread.run_sync(
        lambda: MultipartBody(folder, mark) if mark else RawBody(folder, called)
    )
    try:
        left = int(request.headers.get("content-length", 0))
        with backend.limited_wait() as scope:
            async for block in _blocks(request):
                left = max(left, len(block))
                await to_thread.run_sync(check_disk_space, folder, left, settings.min_free_bytes)
                await to_thread.run_sync(body.feed, block)
                left -= len(block)
        if scope.cancelled_caught:
            await _refuse_rest(request)
        parts, fields = await to_thread.run_sync(body.finish)
        yield Upload(parts, fields)
    finally:
        with CancelScope(shield=True):
            await to_thread.run_sync(body.discard)


async def _blocks(request: Request) -> AsyncIterator[bytes]:
    """The body in blocks large enough that handing one to a thread costs little."""
    block = bytearray()
    async for chunk in request.stream():
        block += chunk
        if len(block) >= BLOCK_BYTES:
            yield bytes(block)
            block.clear()
    if block:
        yield bytes(block)


async def _refuse_rest(request: Request) -> NoReturn:
    """Raise the refusal of a process that stops, after a moment: closed on unread bytes, the connection loses it."""
    with move_on_after(FAREWELL_SECONDS):
        async for _ in request.stream():
            pass
    raise RequestProblem("not-ready", "The service is stopping. Nothing is stored; send it again in a moment.")
