"""Status as server-sent events: each change once, a sign of life every 15 s, the end after the last change."""

from collections.abc import AsyncGenerator, AsyncIterator, Awaitable, Callable
from contextlib import AbstractContextManager, aclosing

from anyio import current_time

from caesura.service.backend import Backend
from caesura.service.documents import StatusDocument
from caesura.worker.records.schema import SegmentationRecord

QUIET_SECONDS = 15.0

IsAdmitted = Callable[[], Awaitable[bool]]
"""Whether who listens may still do so."""


def event_id(record: SegmentationRecord) -> str:
    """Names one state of a record: what a client sends back as Last-Event-ID."""
    return f"{record.updated:.6f}"


async def counted_stream(seat: AbstractContextManager[None], stream: AsyncGenerator[str]) -> AsyncIterator[str]:
    """The same stream, which takes a seat from its first word until it is over or left."""
    with seat:
        async with aclosing(stream):
            async for text in stream:
                yield text


async def status_events(backend: Backend, identifier: str, last_seen: str, admitted: IsAdmitted) -> AsyncGenerator[str]:
    """The stream's text: `status` events with a status document each; `deleted` where it is deleted meanwhile.

    A state that the client has seen, as its Last-Event-ID says, is not sent again. It ends before the next word, and
    within the seconds after which the record is read again, where the listener is no longer `admitted`.
    """
    yield ": caesura\n\n"
    spoke = current_time()
    async with aclosing(backend.records.changes(identifier)) as changes:
        while True:
            with backend.limited_wait() as patience:
                record = await anext(changes)
            if patience.cancelled_caught or not await admitted():
                return
            if record is None:
                yield "event: deleted\ndata: {}\n\n"
                return
            if event_id(record) != last_seen:
                last_seen, spoke = event_id(record), current_time()
                document = StatusDocument.of(record, await backend.position(record))
                yield f"event: status\nid: {last_seen}\ndata: {document.model_dump_json()}\n\n"
            elif current_time() - spoke >= QUIET_SECONDS:
                spoke = current_time()
                yield ": waiting\n\n"
            if not record.live:
                return
