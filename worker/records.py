"""Reading and changing records. Every change is one MULTI that also tells it on the segmentation's channel."""

import asyncio
import time
from collections.abc import AsyncGenerator, Callable, Iterable
from contextlib import aclosing
from typing import Any

import redis
import redis.asyncio
from redis.client import Pipeline

from worker import schema
from worker.schema import AnalysisRecord, AnimationRecord, ExportRecord, SegmentationRecord

LEASE_SECONDS = 20  # an attempt whose worker gave no sign for so long is lost
REREAD_SECONDS = 3.0  # a message may be missed where a connection breaks

Change = Callable[[SegmentationRecord], SegmentationRecord | None]
Also = Callable[[Pipeline, SegmentationRecord], None]


def connect(url: str) -> redis.Redis:
    """A client for short calls; it connects at first use."""
    return redis.Redis.from_url(url, health_check_interval=30)


class Records:
    """The records of one Redis, for workers and thread pools."""

    def __init__(self, client: redis.Redis) -> None:
        self.redis = client

    # Animations.

    def add_animation(self, record: AnimationRecord) -> tuple[AnimationRecord, bool]:
        """Keep a new animation: (the record that is kept, whether it is this one).

        Where it was there before, with its files, the stored record is answered; the caller then deletes its own.
        """
        key = schema.animation_key(record.id)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(key)
                kept = _animation(pipe.get(key))
                if kept is not None and kept.parts:
                    return kept, False
                pipe.multi()
                pipe.set(key, record.model_dump_json())
                pipe.zadd(schema.animations_key(record.owner), {record.id: record.created})
                pipe.zadd(schema.USED_KEY, {record.id: record.created})
                try:
                    pipe.execute()
                except redis.WatchError:
                    continue
                return record, True

    def strip_animation(self, record: AnimationRecord) -> None:
        """Forget where its files were: they are gone."""
        self.redis.set(
            schema.animation_key(record.id), record.model_copy(update={"parts": ()}).model_dump_json(), xx=True
        )

    def uses(self) -> dict[str, float]:
        """When each animation was used last: uploaded, or asked to be cut."""
        return {name: score for (name,), score in ((_names([n]), s) for n, s in self.redis.zscan_iter(schema.USED_KEY))}

    def animation(self, identifier: str) -> AnimationRecord | None:
        """The animation, or None."""
        return _animation(self.redis.get(schema.animation_key(identifier)))

    def delete_animation(self, record: AnimationRecord) -> None:
        """Forget an animation; its blobs, analyses and segmentations are the caller's to delete before."""
        with self.redis.pipeline() as pipe:
            pipe.delete(schema.animation_key(record.id))
            pipe.zrem(schema.animations_key(record.owner), record.id)
            pipe.zrem(schema.USED_KEY, record.id)
            pipe.execute()

    # Analyses.

    def analysis(self, animation: str, digest: str) -> AnalysisRecord | None:
        """The analysis of an animation with certain heavy parameters (`ids.heavy_digest`), or None."""
        stored = self.redis.get(schema.analysis_key(animation, digest))
        return None if stored is None else AnalysisRecord.model_validate_json(stored)

    def add_analysis(self, animation: str, digest: str, record: AnalysisRecord) -> AnalysisRecord | None:
        """Keep an analysis, and answer the one that is kept: this, or another that was there before.

        None where the animation was deleted meanwhile: then nothing is kept.
        """
        key = schema.analysis_key(animation, digest)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(schema.animation_key(animation))
                if not pipe.exists(schema.animation_key(animation)):
                    return None
                pipe.multi()
                pipe.set(key, record.model_dump_json(), nx=True)
                pipe.sadd(schema.analyses_key(animation), digest)
                pipe.get(key)
                try:
                    return AnalysisRecord.model_validate_json(pipe.execute()[-1])
                except redis.WatchError:
                    continue

    def analyses(self, animation: str) -> dict[str, AnalysisRecord]:
        """All analyses of an animation, by digest."""
        digests = sorted(_names(self.redis.smembers(schema.analyses_key(animation))))
        found = {digest: self.analysis(animation, digest) for digest in digests}
        return {digest: record for digest, record in found.items() if record is not None}

    def delete_analysis(self, animation: str, digest: str) -> None:
        """Forget an analysis; its blobs are the caller's to delete."""
        with self.redis.pipeline() as pipe:
            pipe.delete(schema.analysis_key(animation, digest))
            pipe.srem(schema.analyses_key(animation), digest)
            pipe.execute()

    # Segmentations.

    def segmentation(self, identifier: str) -> SegmentationRecord | None:
        """The segmentation, or None."""
        return _segmentation(self.redis.get(schema.segmentation_key(identifier)))

    def segmentations(self, animation: str) -> list[SegmentationRecord]:
        """All segmentations of an animation, newest first."""
        ids = _names(self.redis.zrevrange(schema.segmentations_key(animation), 0, -1))
        return [record for record in map(self.segmentation, ids) if record is not None]

    def live(self) -> list[SegmentationRecord]:
        """All segmentations that are queued or running."""
        ids = sorted(_names(self.redis.smembers(schema.LIVE_KEY)))
        return [record for record in map(self.segmentation, ids) if record is not None and record.live]

    def change(
        self, identifier: str, change: Change, also: Also | None = None, new: SegmentationRecord | None = None
    ) -> SegmentationRecord | None:
        """Replace the record by `change(record)`, together with what `also` puts into the same MULTI.

        `change` sees the stored record, or `new` where there is none, and may answer None: nothing happens then,
        and None is answered. It is called again where another process wrote in between, so it must be pure.
        """
        key = schema.segmentation_key(identifier)
        with self.redis.pipeline() as pipe:
            while True:
                pipe.watch(key)
                before = _segmentation(pipe.get(key)) or new
                after = None if before is None else change(before)
                if after is None:
                    pipe.unwatch()
                    return None
                after = after.with_(updated=time.time())
                pipe.multi()
                self._write(pipe, after)
                if also is not None:
                    also(pipe, after)
                try:
                    pipe.execute()
                except redis.WatchError:
                    continue
                return after

    def of_attempt(self, token: str, identifier: str, **changes: Any) -> SegmentationRecord | None:
        """Change a running segmentation's fields where `token` is still its attempt; None where it is not."""
        return self.change(identifier, lambda r: r.with_(**changes) if _running(r, token) else None)

    def begin(self, identifier: str, token: str) -> SegmentationRecord | None:
        """queued -> running; None where this attempt is no longer wanted, or has begun before."""

        def change(record: SegmentationRecord) -> SegmentationRecord | None:
            wanted = record.token == token and record.status == "queued"
            return record.with_(status="running", stage="", fraction=0.0) if wanted else None

        return self.change(identifier, change, lambda pipe, _: self.renew(token, pipe))

    def renew(self, token: str, client: redis.Redis | None = None) -> None:
        """Say that the attempt's worker lives."""
        (client or self.redis).set(schema.lease_key(token), b"1", ex=LEASE_SECONDS)

    def finish(self, identifier: str, token: str, document: str, arrays: dict[str, bytes], **summary: Any) -> bool:
        """running -> done, with the result document and the byte arrays `energy` and `labels`, all at once."""

        def also(pipe: Pipeline, _: SegmentationRecord) -> None:
            pipe.set(schema.segmentation_key(identifier, "document"), document)
            pipe.set(schema.segmentation_key(identifier, "energy"), arrays["energy"])
            pipe.set(schema.segmentation_key(identifier, "labels"), arrays["labels"])

        done = {"status": "done", "stage": "", "fraction": 1.0, "problem": None, **summary}
        change: Change = lambda r: r.with_(**done) if _running(r, token) else None  # noqa: E731  one line says it
        return self.change(identifier, change, also) is not None

    def fail(self, identifier: str, token: str, problem: dict[str, Any]) -> bool:
        """running -> failed, with the problem that is answered from now on."""
        return self.of_attempt(token, identifier, status="failed", problem=problem) is not None

    def result(self, identifier: str) -> tuple[bytes | None, bytes | None, bytes | None]:
        """The result document, the energy curve and the labels, as stored."""
        with self.redis.pipeline() as pipe:
            for part in ("document", "energy", "labels"):
                pipe.get(schema.segmentation_key(identifier, part))
            document, energy, labels = pipe.execute()
            return document, energy, labels

    def delete_segmentation(self, record: SegmentationRecord) -> None:
        """Forget a segmentation and its result; cancel it before."""
        with self.redis.pipeline() as pipe:
            parts = [schema.segmentation_key(record.id, part) for part in ("", "document", "energy", "labels")]
            pipe.delete(*parts)
            pipe.zrem(schema.segmentations_key(record.animation), record.id)
            pipe.srem(schema.LIVE_KEY, record.id)
            pipe.publish(schema.channel(record.id), b"deleted")
            pipe.execute()

    # Exports.

    def export(self, segmentation: str, form: str) -> ExportRecord | None:
        """A file made of a result, or None where none was asked for."""
        return _export(self.redis.get(schema.export_key(segmentation, form)))

    def write_export(self, segmentation: str, form: str, record: ExportRecord) -> None:
        """Keep where the file is, or why there is none."""
        with self.redis.pipeline() as pipe:
            pipe.set(schema.export_key(segmentation, form), record.model_dump_json())
            pipe.publish(schema.channel(segmentation), b"export")
            pipe.execute()

    @staticmethod
    def _write(pipe: Pipeline, record: SegmentationRecord) -> None:
        pipe.set(schema.segmentation_key(record.id), record.model_dump_json())
        pipe.zadd(schema.segmentations_key(record.animation), {record.id: record.created})
        (pipe.sadd if record.live else pipe.srem)(schema.LIVE_KEY, record.id)
        pipe.publish(schema.channel(record.id), record.status)


class AsyncRecords:
    """The same records as the web process reads them. It changes nothing: that goes through `Jobs`."""

    def __init__(self, url: str) -> None:
        self.redis: redis.asyncio.Redis = redis.asyncio.Redis.from_url(url, health_check_interval=30)

    async def close(self) -> None:
        """Give the connections back."""
        await self.redis.aclose()

    async def animation(self, identifier: str) -> AnimationRecord | None:
        """The animation, or None."""
        return _animation(await self.redis.get(schema.animation_key(identifier)))

    async def animations(self, owner: str, limit: int, before: float | None = None) -> list[AnimationRecord]:
        """An owner's animations, newest first; `before` is the `created` of the last one seen."""
        highest = "+inf" if before is None else f"({before!r}"
        ids = _names(
            await self.redis.zrevrangebyscore(schema.animations_key(owner), highest, "-inf", start=0, num=limit)
        )
        stored = await self.redis.mget([schema.animation_key(i) for i in ids]) if ids else []
        return [record for record in map(_animation, stored) if record is not None]

    async def segmentation(self, identifier: str) -> SegmentationRecord | None:
        """The segmentation, or None."""
        return _segmentation(await self.redis.get(schema.segmentation_key(identifier)))

    async def segmentations(self, animation: str) -> list[SegmentationRecord]:
        """All segmentations of an animation, newest first."""
        ids = _names(await self.redis.zrevrange(schema.segmentations_key(animation), 0, -1))
        stored = await self.redis.mget([schema.segmentation_key(i) for i in ids]) if ids else []
        return [record for record in map(_segmentation, stored) if record is not None]

    async def document(self, identifier: str) -> bytes | None:
        """The result document, JSON, as stored."""
        return _bytes(await self.redis.get(schema.segmentation_key(identifier, "document")))

    async def energy(self, identifier: str) -> bytes | None:
        """The energy curve: little-endian float32."""
        return _bytes(await self.redis.get(schema.segmentation_key(identifier, "energy")))

    async def labels(self, identifier: str) -> bytes | None:
        """The motion of every frame: little-endian uint16."""
        return _bytes(await self.redis.get(schema.segmentation_key(identifier, "labels")))

    async def export(self, segmentation: str, form: str) -> ExportRecord | None:
        """A file made of a result, or None where none was asked for."""
        return _export(await self.redis.get(schema.export_key(segmentation, form)))

    async def changes(self, identifier: str) -> AsyncGenerator[SegmentationRecord | None, None]:
        """The record now, and again after every change and every 3 s; None once it is deleted.

        Subscribes before it reads, so that no change is missed. Ends never: leave it through
        `async with aclosing(records.changes(id)) as changes`, which gives its connection back.
        """
        async with self.redis.pubsub() as listener:
            await listener.subscribe(schema.channel(identifier))
            await listener.get_message(timeout=REREAD_SECONDS)  # the server's word that it listens
            while True:
                yield await self.segmentation(identifier)
                await listener.get_message(ignore_subscribe_messages=True, timeout=REREAD_SECONDS)

    async def wait(self, identifier: str, seconds: float) -> SegmentationRecord | None:
        """The record as soon as it is no longer live, or as it is after `seconds`."""
        try:
            async with asyncio.timeout(seconds):
                async with aclosing(self.changes(identifier)) as changes:
                    async for record in changes:
                        if record is None or not record.live:
                            return record
        except TimeoutError:
            pass
        return await self.segmentation(identifier)


def _running(record: SegmentationRecord, token: str) -> bool:
    return record.token == token and record.status == "running"


# redis-py says `bytes | str` of every value; without `decode_responses` it is bytes.


def _names(values: Iterable[Any]) -> list[str]:
    return [bytes(value).decode() for value in values]


def _bytes(stored: bytes | str | None) -> bytes | None:
    return stored.encode() if isinstance(stored, str) else stored


def _animation(stored: bytes | str | None) -> AnimationRecord | None:
    return None if stored is None else AnimationRecord.model_validate_json(stored)


def _segmentation(stored: bytes | str | None) -> SegmentationRecord | None:
    return None if stored is None else SegmentationRecord.model_validate_json(stored)


def _export(stored: bytes | str | None) -> ExportRecord | None:
    return None if stored is None else ExportRecord.model_validate_json(stored)
