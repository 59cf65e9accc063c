"""Collections and what is in them as a request names them, and the wait for what is worked on."""

from collections.abc import Awaitable, Callable
from contextlib import aclosing
from typing import TypeVar

from anyio import to_thread
from fastapi import Request

from caesura.service.backend import Backend
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.queue.collection_jobs import fail_if_lost
from caesura.worker.records.async_collections import AsyncCollections
from caesura.worker.records.collection_types import CollectionRecord, ProposalRecord, SearchRecord, TakeRecord

Wanted = TypeVar("Wanted", ProposalRecord, SearchRecord)


async def find_collection(backend: Backend, identifier: str, owner: str) -> CollectionRecord:
    """The collection, or the refusal to say whether it exists."""
    record = await AsyncCollections(backend.records).owned(identifier, owner)
    if record is None:
        raise RequestProblem("not-found", f"There is no collection {identifier}. It may have been deleted.")
    return record


async def find_take(backend: Backend, identifier: str, animation: str) -> TakeRecord:
    """A take of a collection that the owner has."""
    record = await AsyncCollections(backend.records).take(identifier, animation)
    if record is None:
        raise RequestProblem("not-found", f"The collection has no animation {animation}.")
    return record


async def wait_for(backend: Backend, request: Request, identifier: str, ready: Callable[[], Awaitable[bool]]) -> None:
    """Wait until it is ready, as long as the client prefers; looks at every change of the collection."""
    seconds = preferred_wait_seconds(request)
    if not seconds:
        return
    with backend.limited_wait(seconds):
        async with aclosing(AsyncCollections(backend.records).follow(identifier)) as changes:
            async for _ in changes:
                if await ready():
                    return


async def find_ended(
    backend: Backend, request: Request, identifier: str, find: Callable[[], Awaitable[Wanted]]
) -> Wanted:
    """A proposal or search as soon as it is over, or the client waits no longer; failed where its job is lost."""
    kept = await find()
    if kept.status != "working":
        return kept

    async def ready() -> bool:
        return (await find()).status != "working"

    await wait_for(backend, request, identifier, ready)
    await to_thread.run_sync(fail_if_lost, backend.jobs, identifier, kept)
    return await find()
