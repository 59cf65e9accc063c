"""The calls of an upload on disk: it takes a piece, becomes an animation once it is whole, or ends."""

from collections.abc import AsyncIterator
from contextlib import AbstractContextManager
from functools import partial
from io import FileIO
from pathlib import Path

from anyio import CancelScope, to_thread
from fastapi import Request
from starlette.requests import ClientDisconnect

from caesura.core.errors import CaesuraError
from caesura.service.backend import Backend
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.uploads.registration import register_upload
from caesura.service.uploads.resumable import partial_file, upload_records
from caesura.service.uploads.resumable.tus_headers import partial_folder
from caesura.service.uploads.spool import Part
from caesura.service.uploads.upload_body import BLOCK_BYTES
from caesura.worker.records.record_types import UploadRecord
from caesura.worker.store.disk_space import check_disk_space

Held = AbstractContextManager[FileIO]


def upload_path(backend: Backend, record: UploadRecord) -> Path:
    """Where its pieces are."""
    return partial_folder(backend.settings.scratch_dir) / record.id


async def received_bytes(backend: Backend, record: UploadRecord) -> int:
    """How many bytes of an upload have come."""
    if record.animation:
        return record.length
    return await to_thread.run_sync(partial_file.received_bytes, upload_path(backend, record))


async def take_piece(backend: Backend, request: Request, record: UploadRecord, offset: int) -> tuple[int, str]:
    """Append the body at `offset`: (the offset after it, the animation that it is where it is whole now).

    What came before a connection broke stays. Raises `RequestProblem` where the offset is another, or more comes than
    was announced; what the reader of the file raises where it is whole and cannot be read: then it is forgotten.
    """
    path = upload_path(backend, record)
    held: Held = partial_file.held_file(path)
    file = await to_thread.run_sync(held.__enter__)
    try:
        present = await to_thread.run_sync(partial_file.received_bytes, path)
        if present != offset:
            detail = f"{present} bytes have come so far, and the piece begins at {offset}. Go on from there."
            raise RequestProblem("wrong-offset", detail, actual=present)
        after = await _append(backend, request, record, file, present)
        if after < record.length:
            return after, ""
        return after, await to_thread.run_sync(_complete, backend, record, path)
    finally:
        with CancelScope(shield=True):
            await to_thread.run_sync(held.__exit__, None, None, None)


async def _append(backend: Backend, request: Request, record: UploadRecord, file: FileIO, present: int) -> int:
    """Write the body, block by block, and answer how much there is then."""
    settings, count = backend.settings, present
    try:
        async for block in _bounded(_blocks(request), record.length - present):
            left = max(record.length - count, len(block))
            await to_thread.run_sync(check_disk_space, backend.settings.scratch_dir, left, settings.min_free_bytes)
            await to_thread.run_sync(partial_file.append, file, block)
            count += len(block)
    finally:
        with CancelScope(shield=True):
            count = await to_thread.run_sync(partial_file.sync, file)
    return count


async def _blocks(request: Request) -> AsyncIterator[bytes]:
    """The body in blocks; where the connection breaks, what came until then, so that every try gets further."""
    block = bytearray()
    try:
        async for chunk in request.stream():
            block += chunk
            if len(block) >= BLOCK_BYTES:
                yield bytes(block)
                block.clear()
    except ClientDisconnect:
        pass
    if block:
        yield bytes(block)


async def _bounded(blocks: AsyncIterator[bytes], most: int) -> AsyncIterator[bytes]:
    """The blocks, of which all together have at most so many bytes."""
    async for block in blocks:
        if len(block) > most:
            detail = f"The piece is longer than the {most} bytes that are still to come, as Upload-Length says."
            raise RequestProblem("piece-too-long", detail, limit=most)
        most -= len(block)
        yield block


def _complete(backend: Backend, record: UploadRecord, path: Path) -> str:
    """Make an animation of the whole file. Blocks: run it on a thread."""
    part = Part(record.name, path, record.length, partial_file.file_digest(path))
    redis = backend.jobs.redis
    try:
        animation, _ = register_upload(backend, record.owner, (part,), record.name)
    except CaesuraError as refused:
        if refused.kind != "worker":  # what is wrong with the file will not change; a full disk may
            upload_records.delete_upload(redis, record)
            path.unlink(missing_ok=True)
        raise
    upload_records.finish_upload(redis, record, animation.id)
    path.unlink(missing_ok=True)  # it was known already
    return animation.id


def end_upload(backend: Backend, record: UploadRecord) -> None:
    """Delete what came, and forget it. Blocks: run it on a thread."""
    path = upload_path(backend, record)
    with partial_file.held_file(path):
        upload_records.delete_upload(backend.jobs.redis, record)
        path.unlink(missing_ok=True)


def delete_forgotten_uploads(backend: Backend) -> None:
    """Delete pieces of uploads whose time is up. Blocks: run it on a thread."""
    folder = partial_folder(backend.settings.scratch_dir)
    partial_file.delete_forgotten_files(folder, partial(upload_records.is_known, backend.jobs.redis))
