"""Records of segmentations, with their results. Every change is one MULTI and is published on their channel."""

import time
from collections.abc import Callable

import redis
from redis.client import Pipeline

from caesura.core.errors import CaesuraError
from caesura.worker.records import counters, redis_keys
from caesura.worker.records.callbacks import put_deliveries, waiting_callbacks
from caesura.worker.records.connection import decode_names, transact
from caesura.worker.records.record_types import SegmentationRecord

Change = Callable[[SegmentationRecord], SegmentationRecord | None]
AlsoWrite = Callable[[Pipeline, SegmentationRecord], None]
Follow = Callable[[Pipeline, str], None]
"""Has what waited for a segmentation go on: it is over."""


class AnimationDeleted(CaesuraError):
    """A segmentation was asked for of what is not there any more."""

    kind = "request"


class Segmentations:
    """The segmentations of one Redis."""

    def __init__(self, client: redis.Redis, follow: Follow = lambda *_: None) -> None:
        self._redis = client
        self.follow = follow

    def one(self, identifier: str) -> SegmentationRecord | None:
        """The segmentation, or None."""
        return SegmentationRecord.read(self._redis.get(redis_keys.segmentation_key(identifier)))

    def of(self, animation: str) -> list[SegmentationRecord]:
        """All segmentations of an animation, newest first."""
        ids = decode_names(self._redis.zrevrange(redis_keys.segmentations_key(animation), 0, -1))
        return [record for record in map(self.one, ids) if record is not None]

    def index(self, record: SegmentationRecord) -> None:
        """List a segmentation of an earlier version among its owner's, unless it was deleted meanwhile."""
        key = redis_keys.segmentation_key(record.id)

        def write(pipe: Pipeline) -> None:
            exists = pipe.exists(key)
            pipe.multi()
            if exists:
                pipe.zadd(redis_keys.owned_segmentations_key(record.owner), {record.id: record.created})

        if self._redis.zscore(redis_keys.owned_segmentations_key(record.owner), record.id) is None:
            transact(self._redis, write, key)

    def live(self) -> list[SegmentationRecord]:
        """All segmentations that are queued or running."""
        ids = sorted(decode_names(self._redis.smembers(redis_keys.LIVE_SEGMENTATIONS_KEY)))
        return [record for record in map(self.one, ids) if record is not None and record.live]

    def result(self, identifier: str) -> tuple[bytes | None, bytes | None, bytes | None]:
        """The result document, the energy curve and the labels, as stored."""
        with self._redis.pipeline() as pipe:
            for part in ("document", "energy", "labels"):
                pipe.get(redis_keys.segmentation_key(identifier, part))
            document, energy, labels = pipe.execute()
            return document, energy, labels

    def change(
        self, identifier: str, change: Change, also: AlsoWrite | None = None, new: SegmentationRecord | None = None
    ) -> SegmentationRecord | None:
        """Replace the record by `change(record)`, together with what `also` puts into the same MULTI.

        `change` sees the stored record, or `new` where there is none, and may answer None: nothing happens then,
        and None is answered. It is called again where another process wrote in between, so it must be pure.
        Raises `AnimationDeleted` where it would be `new`, and what it is of has gone meanwhile.
        """
        key = redis_keys.segmentation_key(identifier)

        def write(pipe: Pipeline) -> SegmentationRecord | None:
            stored = SegmentationRecord.read(pipe.get(key))
            if stored is None and new is not None:
                _watch_animation(pipe, new.animation)
            before = stored or new
            after = None if before is None else change(before)
            if after is None:
                pipe.unwatch()
                return None
            after = _with_times(before, after, time.time())
            over = before is not None and before.live and not after.live
            urls = waiting_callbacks(pipe, identifier) if over else []
            awaiting = decode_names(pipe.smembers(redis_keys.awaiting_key(identifier))) if over else []
            pipe.multi()
            _write(pipe, after)
            counters.count_change(pipe, before, after)
            if urls:
                put_deliveries(pipe, after, urls)
            for collection in awaiting:
                self.follow(pipe, collection)
            if awaiting:
                pipe.delete(redis_keys.awaiting_key(identifier))
            if also is not None:
                also(pipe, after)
            return after

        beside = (redis_keys.callbacks_key(identifier), redis_keys.awaiting_key(identifier))
        return transact(self._redis, write, key, *beside)

    def delete(self, record: SegmentationRecord) -> bool:
        """Forget a segmentation and its result; False, and nothing is forgotten, where it is live again: cancel it."""
        with self._redis.pipeline() as pipe:
            key = redis_keys.segmentation_key(record.id)
            pipe.watch(key)
            kept = SegmentationRecord.read(pipe.get(key))
            if kept is not None and kept.live:
                return False
            pipe.multi()
            parts = [redis_keys.segmentation_key(record.id, part) for part in ("document", "energy", "labels")]
            pipe.delete(key, *parts, redis_keys.revisions_key(record.id), redis_keys.revised_key(record.id))
            pipe.delete(redis_keys.alternatives_key(record.id), redis_keys.callbacks_key(record.id))
            pipe.zrem(redis_keys.segmentations_key(record.animation), record.id)
            pipe.zrem(redis_keys.owned_segmentations_key(record.owner), record.id)
            pipe.zrem(redis_keys.edited_key(record.animation), record.id)
            pipe.srem(redis_keys.LIVE_SEGMENTATIONS_KEY, record.id)
            pipe.set(redis_keys.DELETED_KEY, b"1")
            pipe.publish(redis_keys.channel(record.id), b"deleted")
            try:
                pipe.execute()
            except redis.WatchError:
                return False
            return True


def _with_times(before: SegmentationRecord | None, after: SegmentationRecord, now: float) -> SegmentationRecord:
    """When it was changed, and when its attempt began and ended."""
    began = after.status == "running" and (before is None or before.status != "running")
    started = now if began else 0.0 if after.status == "queued" else after.started
    finished = 0.0 if after.live else after.finished or (now if before is None or before.live else 0.0)
    return after.with_changes(updated=now, started=started, finished=finished)


def _write(pipe: Pipeline, record: SegmentationRecord) -> None:
    pipe.set(redis_keys.segmentation_key(record.id), record.model_dump_json())
    pipe.zadd(redis_keys.segmentations_key(record.animation), {record.id: record.created})
    pipe.zadd(redis_keys.owned_segmentations_key(record.owner), {record.id: record.created})
    (pipe.sadd if record.live else pipe.srem)(redis_keys.LIVE_SEGMENTATIONS_KEY, record.id)
    pipe.publish(redis_keys.channel(record.id), record.status)


def _watch_animation(pipe: Pipeline, identifier: str) -> None:
    """Whoever deletes it from now on spoils the MULTI: nothing is kept that nobody would delete any more."""
    pipe.watch(redis_keys.animation_key(identifier))
    if not pipe.exists(redis_keys.animation_key(identifier)):
        raise AnimationDeleted("animation-deleted", "The animation was deleted meanwhile. Upload it again.")
