"""Records of uploads, each in its owner's list, and all by the time of their last use."""

import time

import redis
from redis.client import Pipeline

from caesura.worker.records import redis_keys
from caesura.worker.records.connection import decode_names, transact
from caesura.worker.records.record_types import TAKES, AnimationRecord, TakeSummary


class Animations:
    """The uploads of one Redis."""

    def __init__(self, client: redis.Redis) -> None:
        self._redis = client

    def one(self, identifier: str) -> AnimationRecord | None:
        """The animation, or None."""
        return AnimationRecord.read(self._redis.get(redis_keys.animation_key(identifier)))

    def takes(self, record: AnimationRecord) -> tuple[TakeSummary, ...]:
        """The takes of an animation."""
        return record.takes or TAKES.validate_json(self._redis.get(redis_keys.takes_key(record.id)) or b"[]")

    def add(self, record: AnimationRecord, takes: tuple[TakeSummary, ...] = ()) -> tuple[AnimationRecord, bool]:
        """Keep a new animation: (the record that is kept, whether it is this one).

        Where it was there before, with its files, the stored record is answered; the caller then deletes its own.
        """
        key = redis_keys.animation_key(record.id)

        def keep(pipe: Pipeline) -> tuple[AnimationRecord, bool]:
            kept = AnimationRecord.read(pipe.get(key))
            pipe.multi()
            if kept is not None and kept.parts:
                return kept, False
            pipe.set(key, record.model_dump_json())
            pipe.set(redis_keys.takes_key(record.id), TAKES.dump_json(takes))
            pipe.zadd(redis_keys.animations_key(record.owner), {record.id: record.created})
            pipe.zadd(redis_keys.LAST_USED_KEY, {record.id: record.created})
            return record, True

        return transact(self._redis, keep, key)

    def rename(self, identifier: str, name: str) -> AnimationRecord | None:
        """Call an animation otherwise; answers it as it was before, or None where it has gone."""
        key = redis_keys.animation_key(identifier)

        def write(pipe: Pipeline) -> AnimationRecord | None:
            before = AnimationRecord.read(pipe.get(key))
            pipe.multi()
            if before is not None:
                pipe.set(key, before.model_copy(update={"name": name}).model_dump_json())
            return before

        return transact(self._redis, write, key)

    def strip(self, record: AnimationRecord) -> None:
        """Forget where its files were: they are gone."""
        self._redis.set(
            redis_keys.animation_key(record.id), record.model_copy(update={"parts": ()}).model_dump_json(), xx=True
        )

    def uses(self) -> dict[str, float]:
        """When each animation was used last: uploaded, or asked to be cut."""
        return {
            name: score
            for (name,), score in ((decode_names([n]), s) for n, s in self._redis.zscan_iter(redis_keys.LAST_USED_KEY))
        }

    def touch(self, identifier: str) -> None:
        """It is used now, and so kept from now on."""
        self._redis.zadd(redis_keys.LAST_USED_KEY, {identifier: time.time()}, xx=True)

    def delete(self, record: AnimationRecord) -> bool:
        """Forget an animation; its blobs, analyses and segmentations are the caller's to delete before.

        False, and nothing is forgotten, where it has segmentations: one was asked for in this moment.
        """
        with self._redis.pipeline() as pipe:
            pipe.watch(redis_keys.segmentations_key(record.id))
            if pipe.exists(redis_keys.segmentations_key(record.id)):
                return False
            pipe.multi()
            pipe.delete(redis_keys.animation_key(record.id), redis_keys.takes_key(record.id))
            pipe.zrem(redis_keys.animations_key(record.owner), record.id)
            pipe.zrem(redis_keys.LAST_USED_KEY, record.id)
            pipe.set(redis_keys.DELETED_KEY, b"1")
            try:
                pipe.execute()
            except redis.WatchError:
                return False
            return True
