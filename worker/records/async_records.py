"""The records as the web process reads them: without blocking, and waiting without asking again and again."""

from collections.abc import AsyncGenerator
from contextlib import aclosing

from redis.asyncio import BlockingConnectionPool, Redis

from caesura.worker.records import redis_keys
from caesura.worker.records.connection import decode_names
from caesura.worker.records.record_types import TAKES, AnimationRecord, ExportRecord, SegmentationRecord, TakeSummary
from caesura.worker.records.subscription import ChannelListener, Messages

MOST_CONNECTIONS = 16
"""To Redis, beside the one that listens. A call waits where all are in use: to make one takes longer than a call."""
REREAD_SECONDS = 3.0  # a message may be missed where a connection breaks
LIVE_STATES: Messages = frozenset({b"queued", b"running"})


class AsyncRecords:
    """The same records as the web process reads them. It changes nothing: that goes through `Jobs`."""

    def __init__(self, url: str) -> None:
        self.redis: Redis = Redis.from_pool(
            BlockingConnectionPool.from_url(url, health_check_interval=30, max_connections=MOST_CONNECTIONS)
        )
        self._listener = ChannelListener(self.redis)

    async def close(self) -> None:
        """Give the connections back."""
        await self._listener.close()
        await self.redis.aclose()

    async def owned_animation(self, identifier: str, owner: str) -> AnimationRecord | None:
        """The owner's animation; None where there is none, or it is another's."""
        record = AnimationRecord.read(await self.redis.get(redis_keys.animation_key(identifier)))
        return record if record is not None and record.owner == owner else None

    async def animations(self, owner: str, limit: int, before: float | None = None) -> list[AnimationRecord]:
        """An owner's animations, newest first; `before` is the `created` of the last one seen."""
        ids = await self._newest(redis_keys.animations_key(owner), limit, before)
        stored = await self.redis.mget([redis_keys.animation_key(i) for i in ids]) if ids else []
        return [record for record in map(AnimationRecord.read, stored) if record is not None]

    async def takes(self, record: AnimationRecord) -> tuple[TakeSummary, ...]:
        """The takes of an animation."""
        return record.takes or TAKES.validate_json(await self.redis.get(redis_keys.takes_key(record.id)) or b"[]")

    async def segmentation(self, identifier: str) -> SegmentationRecord | None:
        """The segmentation, or None."""
        return SegmentationRecord.read(await self.redis.get(redis_keys.segmentation_key(identifier)))

    async def owned_segmentation(self, identifier: str, owner: str) -> SegmentationRecord | None:
        """The owner's segmentation; None where there is none, or it is another's."""
        # The parts of a result lie under keys that begin like the record's: `ID:document` is no id.
        record = None if ":" in identifier else await self.segmentation(identifier)
        return record if record is not None and record.owner == owner else None

    async def segmentations(
        self, animation: str, limit: int, before: float | None = None
    ) -> AsyncGenerator[SegmentationRecord]:
        """The segmentations of an animation, newest first, one read after the other: each may have many segments."""
        for identifier in await self._newest(redis_keys.segmentations_key(animation), limit, before):
            record = await self.segmentation(identifier)
            if record is not None:
                yield record

    async def _newest(self, key: str, limit: int, before: float | None) -> list[str]:
        highest = "+inf" if before is None else f"({before!r}"
        return decode_names(await self.redis.zrevrangebyscore(key, highest, "-inf", start=0, num=limit))

    async def document(self, identifier: str) -> bytes | str | None:
        """The result document, JSON, as stored."""
        return await self.redis.get(redis_keys.segmentation_key(identifier, "document"))

    async def export(self, segmentation: str, form: str) -> ExportRecord | None:
        """A file made of a result, or None where none was asked for."""
        return ExportRecord.read(await self.redis.get(redis_keys.export_key(segmentation, form)))

    async def follow_changes(
        self, identifier: str, deaf: Messages = frozenset()
    ) -> AsyncGenerator[SegmentationRecord | None]:
        """The record now, and again after every change and every 3 s; None once it is deleted.

        Listens before it reads, so that no change is missed. Words that it is `deaf` to are changes that do not
        matter. Ends never: leave it through `async with aclosing(records.changes(id)) as changes`.
        """
        channel = redis_keys.channel(identifier)
        async with self._listener.subscribe(channel, deaf) as ear:
            while True:
                yield await self.segmentation(identifier)
                await ear.wait(REREAD_SECONDS)
                await self._listener.listen(channel)

    async def wait_until_ended(self, identifier: str) -> SegmentationRecord | None:
        """The record as soon as it is no longer live; None once it is deleted. Waits for ever."""
        async with aclosing(self.follow_changes(identifier, LIVE_STATES)) as changes:
            async for record in changes:
                if record is None or not record.live:
                    return record
        raise AssertionError("changes never end")
