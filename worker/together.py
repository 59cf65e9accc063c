"""Reads of Redis that come at the same time go there together: most of what a small read costs is the way."""

import asyncio
from contextlib import suppress

import redis.asyncio


class Together:
    """GET, for many at once. While one MGET is under way, what is asked for meanwhile waits to be the next one.

    Nobody waits for longer than two ways, and nobody is answered with what was read before the question.
    """

    def __init__(self, client: redis.asyncio.Redis) -> None:
        self._redis = client
        self._asked: dict[str, asyncio.Future[bytes | None]] = {}
        self._way: asyncio.Task[None] | None = None

    async def get(self, key: str) -> bytes | None:
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
        """One MGET after the other, until nobody asks."""
        try:
            while self._asked:
                asked, self._asked = self._asked, {}
                try:
                    values = await self._redis.mget(list(asked))
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
