"""The records as the web process reads them: without blocking, and waiting without asking again and again."""

from collections.abc import AsyncGenerator, Sequence
from contextlib import aclosing
from dataclasses import dataclass

from redis.asyncio import BlockingConnectionPool, Redis

from caesura.worker.records import redis_keys
from caesura.worker.records.connection import decode_names
from caesura.worker.records.record_types import (
    TAKES,
    AnimationRecord,
    ExportRecord,
    SegmentationRecord,
    Status,
    TakeSummary,
)
from caesura.worker.records.subscription import ChannelListener, Messages

MOST_CONNECTIONS = 16
"""To Redis, beside the one that listens. A call waits where all are in use: to make one takes longer than a call."""
SEARCHED_AT_ONCE, MOST_SEARCHED = 100, 2000
"""Animations that a search by name reads together, and in all."""
REREAD_SECONDS = 3.0  # a message may be missed where a connection breaks
LIVE_STATES: Messages = frozenset({b"queued", b"running"})


@dataclass(frozen=True)
class SegmentationFilter:
    """Whose segmentations are listed, and which: of one animation, in one state, made at or after a time."""

    owner: str
    animation: str = ""
    status: Status | None = None
    since: float | None = None

    def takes(self, record: SegmentationRecord) -> bool:
        """Whether a record is one of them."""
        return record.owner == self.owner and self.status in {None, record.status}


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

    async def find_animations(
        self, owner: str, limit: int, before: float | None, words: str
    ) -> tuple[list[AnimationRecord], float | None]:
        """Those whose names hold `words`, in any case of letters, and the time to go on from; None at the end.

        Looks at `MOST_SEARCHED` animations at most, so there may be fewer than `limit`, and still more to come.
        """
        found: list[AnimationRecord] = []
        at_once = SEARCHED_AT_ONCE if words else limit
        for _ in range(MOST_SEARCHED // at_once):
            page = await self.animations(owner, at_once, before)
            for record in page:
                before = record.created
                if words.casefold() in record.name.casefold():
                    found.append(record)
                if len(found) == limit:
                    return found, before
            if len(page) < at_once:
                return found, None
        return found, before

    async def last_edited(self, animations: Sequence[str]) -> list[str | None]:
        """Of each animation the segmentation that a person edited last; None where nobody has edited any."""
        async with self.redis.pipeline() as pipe:
            for animation in animations:
                pipe.zrevrange(redis_keys.edited_key(animation), 0, 0)
            return [next(iter(decode_names(newest)), None) for newest in await pipe.execute()]

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

    async def find_segmentations(
        self, wanted: SegmentationFilter, limit: int, before: float | None
    ) -> tuple[list[SegmentationRecord], float | None]:
        """Those that are wanted, newest first and without their segments, and the time to go on from; None at the end.

        They are read one after the other, for each may have many segments. Looks at `MOST_SEARCHED` at most, so there
        may be fewer than `limit`, and still more to come.
        """
        key = (
            redis_keys.segmentations_key(wanted.animation)
            if wanted.animation
            else redis_keys.owned_segmentations_key(wanted.owner)
        )
        found: list[SegmentationRecord] = []
        for _ in range(MOST_SEARCHED // SEARCHED_AT_ONCE):
            ids = await self._newest(key, SEARCHED_AT_ONCE, before, wanted.since)
            for identifier in ids:
                record = await self.segmentation(identifier)
                if record is None:
                    continue
                before = record.created
                if wanted.takes(record):
                    found.append(record.with_changes(segments=()))
                if len(found) == limit:
                    return found, before
            if len(ids) < SEARCHED_AT_ONCE:
                return found, None
        return found, before

    async def _newest(self, key: str, limit: int, before: float | None, since: float | None = None) -> list[str]:
        highest = "+inf" if before is None else f"({before!r}"
        lowest = "-inf" if since is None else repr(since)
        return decode_names(await self.redis.zrevrangebyscore(key, highest, lowest, start=0, num=limit))

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

    @property
    def listener(self) -> ChannelListener:
        """Who listens to channels for this process."""
        return self._listener

    async def wait_until_ended(self, identifier: str) -> SegmentationRecord | None:
        """The record as soon as it is no longer live; None once it is deleted. Waits for ever."""
        async with aclosing(self.follow_changes(identifier, LIVE_STATES)) as changes:
            async for record in changes:
                if record is None or not record.live:
                    return record
        raise AssertionError("changes never end")
