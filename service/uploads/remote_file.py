"""An upload that the service fetches from an address, bounded in bytes, in time, in redirects and in number.

Every redirect is checked as the address itself was, and every connection goes to the address that was checked. Nothing
of the client's request goes along, and of a refusal only its status is told.
"""

from collections.abc import AsyncGenerator, AsyncIterator
from contextlib import aclosing, asynccontextmanager
from urllib.parse import unquote, urlsplit

import httpcore
from anyio import CancelScope, to_thread

from caesura.service.backend import Backend
from caesura.service.http.file_name import disposition_name
from caesura.service.http.outgoing.checked_connection import connection_pool
from caesura.service.http.outgoing.target_url import TargetUrl, parse_target_url
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.uploads.body_limit import upload_too_large
from caesura.service.uploads.upload_body import BLOCK_BYTES, RawBody, Upload
from caesura.worker.store.disk_space import check_disk_space

FETCHES_AT_ONCE = 4
FETCH_SECONDS = 300.0
SILENT_SECONDS = 10.0
MOST_REDIRECTS = 5
REDIRECTS = frozenset({301, 302, 303, 307, 308})
FOUND = 200

FAULTS = (httpcore.ProtocolError, httpcore.NetworkError, httpcore.TimeoutException, OSError, ValueError)
TIMEOUT = {"connect": SILENT_SECONDS, "read": SILENT_SECONDS, "write": SILENT_SECONDS, "pool": SILENT_SECONDS}


class TooManyFetches(RequestProblem):
    """Try again in a moment."""

    headers = {"Retry-After": "5"}  # noqa: RUF012  as every refusal has them, never changed


@asynccontextmanager
async def fetch_upload(backend: Backend, url: str, name: str) -> AsyncIterator[Upload]:
    """The file at `url`, in the spool until the block ends; called as it is called there, where `name` is empty.

    Raises `RequestProblem` for what is not allowed or does not come, `LimitExceeded` for what is too large.
    """
    target = parse_target_url(url, "url")
    backend.upload_hosts.check(target.host)
    if backend.fetches >= FETCHES_AT_ONCE:
        raise TooManyFetches("too-many-fetches", f"{FETCHES_AT_ONCE} files are fetched already. Try again in a moment.")
    body = await to_thread.run_sync(RawBody, backend.spool, name)
    backend.fetches += 1
    try:
        with backend.limited_wait(FETCH_SECONDS) as scope:
            try:
                await _receive(backend, target, body)
            except FAULTS as fault:
                raise _failed(f"it failed ({type(fault).__name__})") from None
        if scope.cancelled_caught:
            raise _failed(f"it took more than {FETCH_SECONDS:.0f} seconds")
        parts, fields = await to_thread.run_sync(body.finish)
        yield Upload(parts, fields)
    finally:
        backend.fetches -= 1
        with CancelScope(shield=True):
            await to_thread.run_sync(body.discard)


async def _receive(backend: Backend, target: TargetUrl, body: RawBody) -> None:
    """Follow redirects to the file, and take it in block by block."""
    async with connection_pool(backend.address_policy, 1) as pool:
        for _ in range(MOST_REDIRECTS + 1):
            async with pool.stream("GET", target.text, headers=HEADERS, extensions={"timeout": TIMEOUT}) as answer:
                headers = {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in answer.headers}
                if answer.status not in REDIRECTS:
                    _check_answer(backend, answer.status, headers)
                    body.call(disposition_name(headers.get("content-disposition", "")) or _last_step(target))
                    await _take_in(backend, answer, int(headers.get("content-length", 0)), body)
                    return
            before, target = target, target.joined(headers.get("location", ""))
            backend.upload_hosts.check(target.host)
            if (before.scheme, target.scheme) == ("https", "http"):
                raise _failed("it leads from https to http")
    raise _failed(f"it has more than {MOST_REDIRECTS} redirects")


HEADERS = [(b"Accept", b"*/*"), (b"Accept-Encoding", b"identity"), (b"User-Agent", b"Caesura")]


def _check_answer(backend: Backend, status: int, headers: dict[str, str]) -> None:
    if status != FOUND:
        raise _failed(f"its server answered {status}")
    if headers.get("content-encoding", "identity").lower() != "identity":
        raise _failed("its server answered with an encoding that was not asked for")
    announced = int(headers.get("content-length", 0))
    if announced > backend.settings.max_upload_bytes:
        raise upload_too_large(backend.settings.max_upload_bytes, announced)


async def _take_in(backend: Backend, answer: httpcore.Response, announced: int, body: RawBody) -> None:
    settings, count = backend.settings, 0
    async with aclosing(_blocks(answer)) as blocks:
        async for block in blocks:
            count += len(block)
            if count > settings.max_upload_bytes:
                raise upload_too_large(settings.max_upload_bytes, count)
            left = max(announced - count, 0) + len(block)
            await to_thread.run_sync(check_disk_space, backend.spool, left, settings.min_free_bytes)
            await to_thread.run_sync(body.feed, block)


async def _blocks(answer: httpcore.Response) -> AsyncGenerator[bytes]:
    block = bytearray()
    async for chunk in answer.aiter_stream():
        block += chunk
        if len(block) >= BLOCK_BYTES:
            yield bytes(block)
            block.clear()
    if block:
        yield bytes(block)


def _last_step(target: TargetUrl) -> str:
    return unquote(urlsplit(target.text).path.rpartition("/")[2])


def _failed(why: str) -> RequestProblem:
    return RequestProblem("fetch-failed", f"The file could not be fetched from its address: {why}.", parameter="url")
