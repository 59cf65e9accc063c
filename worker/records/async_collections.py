"""Collections as the web process reads them: without blocking. It changes them through `Collections`, on a thread."""

from collections.abc import AsyncGenerator, Sequence

from redis.asyncio import Redis

from caesura.worker.records import redis_keys
from caesura.worker.records.async_records import REREAD_SECONDS, AsyncRecords
from caesura.worker.records.collection_types import (
    CollectionRecord,
    ProposalRecord,
    SearchRecord,
    TakeEntry,
    TakeRecord,
)
from caesura.worker.records.connection import decode_names


class AsyncCollections:
    """The collections of one Redis."""

    def __init__(self, records: AsyncRecords) -> None:
        self._records = records

    @property
    def _redis(self) -> Redis:
        return self._records.redis

    async def owned(self, identifier: str, owner: str) -> CollectionRecord | None:
        """The owner's collection; None where there is none, or it is another's."""
        record = CollectionRecord.read(await self._redis.get(redis_keys.collection_key(identifier)))
        return record if record is not None and record.owner == owner else None

    async def page(self, owner: str, limit: int, before: float | None) -> list[CollectionRecord]:
        """An owner's collections, newest first; `before` is the `created` of the last one seen."""
        highest = "+inf" if before is None else f"({before!r}"
        key = redis_keys.collections_key(owner)
        ids = decode_names(await self._redis.zrevrangebyscore(key, highest, "-inf", start=0, num=limit))
        stored = await self._redis.mget([redis_keys.collection_key(i) for i in ids]) if ids else []
        return [record for record in map(CollectionRecord.read, stored) if record is not None]

    async def takes(self, identifier: str, limit: int, before: float | None) -> list[TakeRecord]:
        """Takes of a collection, the last added first."""
        highest = "+inf" if before is None else f"({before!r}"
        key = redis_keys.collection_order_key(identifier)
        ids = decode_names(await self._redis.zrevrangebyscore(key, highest, "-inf", start=0, num=limit))
        return await self._takes(identifier, ids)

    async def take(self, identifier: str, animation: str) -> TakeRecord | None:
        """One take of a collection, or None."""
        return next(iter(await self._takes(identifier, [animation])), None)

    async def entry(self, identifier: str, animation: str) -> TakeEntry | None:
        """One take in short, or None."""
        return TakeEntry.read(await self._redis.hget(redis_keys.collection_entries_key(identifier), animation))

    async def proposals(self, identifier: str) -> list[ProposalRecord]:
        """All proposals that are kept, newest first."""
        stored = await self._redis.hvals(redis_keys.collection_proposals_key(identifier))
        return sorted(map(ProposalRecord.model_validate_json, stored), key=lambda one: -one.created)

    async def proposal(self, identifier: str, number: str) -> ProposalRecord | None:
        """One proposal, or None."""
        return ProposalRecord.read(await self._redis.hget(redis_keys.collection_proposals_key(identifier), number))

    async def search(self, identifier: str, number: str) -> SearchRecord | None:
        """One search, or None."""
        return SearchRecord.read(await self._redis.hget(redis_keys.collection_searches_key(identifier), number))

    async def follow(self, identifier: str) -> AsyncGenerator[None]:
        """Now, after every change of a collection, its proposals and searches, and every few seconds; without end."""
        channel = redis_keys.channel(identifier)
        async with self._records.listener.subscribe(channel) as ear:
            while True:
                yield
                await ear.wait(REREAD_SECONDS)
                await self._records.listener.listen(channel)

    async def _takes(self, identifier: str, animations: Sequence[str]) -> list[TakeRecord]:
        key = redis_keys.collection_takes_key(identifier)
        stored = await self._redis.hmget(key, list(animations)) if animations else []
        return [take for take in map(TakeRecord.read, stored) if take is not None]
