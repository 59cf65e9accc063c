"""Reads of Redis that come at the same time go there together: most of what a small read costs is the way."""

import asyncio
from collections.abc import Awaitable, Callable, Hashable
from contextlib import suppress
from typing import Any, Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)

Read = Callable[[list[Key]], Awaitable[Any]]
"""Reads many, such as MGET: a list of bytes, None where there is nothing. redis-py types it loosely."""


class Together(Generic[Key]):
    """One read for many at once. While one is under way, what is asked for meanwhile waits to be the next one.

    Nobody waits for longer than two ways, and nobody is answered with what was read before the question.
    """

    def __init__(self, read: Read[Key]) -> None:
        self._read = read
        self._asked: dict[Key, asyncio.Future[bytes | None]] = {}
        self._way: asyncio.Task[None] | None = None

    async def get(self, key: Key) -> bytes | None:
        """The value, or None; raises what redis-py raises."""
        answer = self._asked.get(key)
        if answer is None:
            answer = self._asked[key] = asyncio.get_running_loop().create_future()
        if self._way is None:
            self._way = asyncio.create_task(self._fetch())
        return await asyncio.shield(answer)  # others may wait for the same answer

    async def close(self) -> None:
        """Give up what is under way."""
        if self._way is not None:
            self._way.cancel()
            with suppress(asyncio.CancelledError):
                await self._way

    async def _fetch(self) -> None:
        """One read after the other, until nobody asks."""
        try:
            while self._asked:
                asked, self._asked = self._asked, {}
                try:
                    values = await self._read(list(asked))
                except Exception as fault:  # noqa: BLE001  it is theirs who asked
                    for answer in asked.values():
                        _settle(answer, fault)
                    continue
                for answer, value in zip(asked.values(), values, strict=True):
                    _settle(answer, value)
        finally:
            self._way = None
            for answer in self._asked.values():
                answer.cancel()


def _settle(answer: "asyncio.Future[bytes | None]", outcome: bytes | str | Exception | None) -> None:
    if answer.done():
        return
    if isinstance(outcome, Exception):
        answer.set_exception(outcome)
        answer.exception()  # seen, also where whoever asked has left
    else:
        answer.set_result(outcome.encode() if isinstance(outcome, str) else outcome)  # redis-py types it so
