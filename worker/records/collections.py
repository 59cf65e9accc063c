"""Records of collections. Whatever changes one goes through `change`: one MULTI, with its motions counted anew."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import redis
from pydantic import TypeAdapter
from redis.client import Pipeline

from caesura.worker.records import redis_keys
from caesura.worker.records.collection_types import (
    CollectedSegment,
    CollectionRecord,
    Exemplar,
    MotionRecord,
    MotionSummary,
    ProposalRecord,
    SearchRecord,
    TakeEntry,
    TakeRecord,
)
from caesura.worker.records.connection import decode_names, transact

MOST_PROPOSALS = 20
SEARCH_SECONDS = 24 * 3600
ENTRY: TypeAdapter[TakeEntry] = TypeAdapter(TakeEntry)


@dataclass(frozen=True)
class CollectionChange:
    """What a change writes: the record, and takes that are new, changed or gone."""

    record: CollectionRecord
    put: tuple[TakeRecord, ...] = ()
    removed: tuple[str, ...] = ()


class Collections:
    """The collections of one Redis."""

    def __init__(self, client: redis.Redis) -> None:
        self._redis = client

    def one(self, identifier: str) -> CollectionRecord | None:
        """The collection, or None."""
        return CollectionRecord.read(self._redis.get(redis_keys.collection_key(identifier)))

    def all(self) -> list[str]:
        """The ids of all collections."""
        return decode_names(self._redis.zrange(redis_keys.COLLECTIONS_KEY, 0, -1))

    def with_animation(self, animation: str) -> list[str]:
        """The ids of the collections that an animation is in."""
        return sorted(decode_names(self._redis.smembers(redis_keys.collected_key(animation))))

    def entries(self, identifier: str) -> dict[str, TakeEntry]:
        """Of each take its state and what it has of each motion, by animation."""
        stored = self._redis.hgetall(redis_keys.collection_entries_key(identifier))
        return {
            name: ENTRY.validate_json(kept) for (name,), kept in ((decode_names([n]), k) for n, k in stored.items())
        }

    def takes(self, identifier: str, animations: Iterable[str]) -> list[TakeRecord]:
        """Those of the takes that are in the collection, whole."""
        wanted = list(animations)
        stored = self._redis.hmget(redis_keys.collection_takes_key(identifier), wanted) if wanted else []
        return [take for take in map(TakeRecord.read, stored) if take is not None]

    def all_takes(self, identifier: str) -> list[TakeRecord]:
        """All takes of a collection, whole."""
        stored = self._redis.hvals(redis_keys.collection_takes_key(identifier))
        return [take for take in map(TakeRecord.read, stored) if take is not None]

    def create(self, record: CollectionRecord) -> None:
        """Keep a new collection without takes."""
        with self._redis.pipeline() as pipe:
            pipe.set(redis_keys.collection_key(record.id), record.model_dump_json())
            pipe.zadd(redis_keys.collections_key(record.owner), {record.id: record.created})
            pipe.zadd(redis_keys.COLLECTIONS_KEY, {record.id: record.updated})
            pipe.execute()

    def change(
        self, identifier: str, make: Callable[[CollectionRecord], CollectionChange | None]
    ) -> CollectionRecord | None:
        """Write `make(record)`, and count the motions of all takes; None where it is None, or there is no collection.

        `make` is called again where another process wrote in between, so it must be pure.
        """
        key = redis_keys.collection_key(identifier)

        def write(pipe: Pipeline) -> CollectionRecord | None:
            before = CollectionRecord.read(pipe.get(key))
            made = None if before is None else make(before)
            if before is None or made is None:
                pipe.unwatch()
                return None
            entries = self.entries(identifier)
            gone = [animation for animation in made.removed if animation in entries]
            entries = {name: entry for name, entry in entries.items() if name not in gone}
            entries |= {take.animation: summarise_take(take) for take in made.put}
            after = _counted(made.record.model_copy(update={"version": before.version + 1}), entries)
            pipe.multi()
            _write(pipe, after, made.put, gone)
            return after

        return transact(self._redis, write, key)

    def delete(self, record: CollectionRecord) -> None:
        """Forget a collection; its blobs are the caller's to delete before."""
        animations = list(self.entries(record.id))
        with self._redis.pipeline() as pipe:
            for animation in animations:
                pipe.srem(redis_keys.collected_key(animation), record.id)
            pipe.delete(redis_keys.collection_key(record.id), *redis_keys.keys_of_collection(record.id))
            pipe.zrem(redis_keys.collections_key(record.owner), record.id)
            pipe.zrem(redis_keys.COLLECTIONS_KEY, record.id)
            pipe.set(redis_keys.DELETED_KEY, b"1")
            pipe.publish(redis_keys.channel(record.id), b"deleted")
            pipe.execute()

    def proposal(self, identifier: str, number: str) -> ProposalRecord | None:
        """One proposal, or None."""
        return ProposalRecord.read(self._redis.hget(redis_keys.collection_proposals_key(identifier), number))

    def put_proposal(self, identifier: str, proposal: ProposalRecord) -> None:
        """Keep a proposal, and forget the oldest beyond those that are kept; nothing where the collection is gone."""
        key = redis_keys.collection_proposals_key(identifier)
        older = [ProposalRecord.model_validate_json(kept) for kept in self._redis.hvals(key)]
        over = sorted((one for one in older if one.id != proposal.id), key=lambda one: -one.created)[
            MOST_PROPOSALS - 1 :
        ]

        def write(pipe: Pipeline) -> None:
            exists = pipe.exists(redis_keys.collection_key(identifier))
            pipe.multi()
            if exists:
                pipe.hset(key, proposal.id, proposal.model_dump_json())
                if over:
                    pipe.hdel(key, *(one.id for one in over))
                pipe.publish(redis_keys.channel(identifier), b"proposal")

        transact(self._redis, write, redis_keys.collection_key(identifier))

    def search(self, identifier: str, number: str) -> SearchRecord | None:
        """One search, or None."""
        return SearchRecord.read(self._redis.hget(redis_keys.collection_searches_key(identifier), number))

    def put_search(self, identifier: str, search: SearchRecord) -> None:
        """Keep a search for a day after the last one; nothing where the collection is gone."""
        key = redis_keys.collection_searches_key(identifier)

        def write(pipe: Pipeline) -> None:
            exists = pipe.exists(redis_keys.collection_key(identifier))
            pipe.multi()
            if exists:
                pipe.hset(key, search.id, search.model_dump_json())
                pipe.expire(key, SEARCH_SECONDS)
                pipe.publish(redis_keys.channel(identifier), b"search")

        transact(self._redis, write, redis_keys.collection_key(identifier))


def summarise_take(take: TakeRecord) -> TakeEntry:
    """Its state, and what it has of each motion."""
    found: dict[str, list[CollectedSegment]] = {}
    for segment in take.segments:
        found.setdefault(segment.motion, []).append(segment)
    rate = take.frame_rate or math.inf
    return TakeEntry(
        status=take.status,
        added=take.added,
        seconds=take.seconds,
        motions={name: _summary(of, rate) for name, of in found.items()},
    )


def _summary(segments: list[CollectedSegment], rate: float) -> MotionSummary:
    frames = sum(one.end - one.start for one in segments)
    sure = [(one.end - one.start, one.confidence) for one in segments if one.confidence is not None]
    weight = sum(length for length, _ in sure)
    best = min(segments, key=lambda one: (math.inf if one.distance is None else one.distance, one.start))
    return MotionSummary(
        seconds=frames / rate,
        segments=len(segments),
        confidence=sum(length * value for length, value in sure) / weight if weight else None,
        distance=best.distance,
        start=best.start,
        end=best.end,
        start_seconds=best.start_seconds,
        end_seconds=best.end_seconds,
    )


def _counted(record: CollectionRecord, entries: Mapping[str, TakeEntry]) -> CollectionRecord:
    """The record with its motions and takes counted; a motion that no take has goes, where nobody has named it."""
    having: dict[str, dict[str, MotionSummary]] = {}
    for animation, entry in entries.items():
        for motion, summary in entry.motions.items():
            having.setdefault(motion, {})[animation] = summary
    motions = tuple(_total(motion, having.get(motion.id, {})) for motion in record.motions)
    states = [entry.status for entry in entries.values()]
    return record.model_copy(
        update={
            "motions": tuple(motion for motion in motions if motion.named or motion.segments),
            "takes": len(states),
            "seconds": sum(entry.seconds for entry in entries.values()),
            "waiting": states.count("waiting"),
            "failed": states.count("failed"),
        }
    )


def _total(motion: MotionRecord, having: Mapping[str, MotionSummary]) -> MotionRecord:
    exemplar = None
    if having:
        animation, best = min(
            having.items(), key=lambda one: (math.inf if one[1].distance is None else one[1].distance, one[0])
        )
        exemplar = Exemplar(
            animation=animation, start=best.start, end=best.end,
            start_seconds=best.start_seconds, end_seconds=best.end_seconds,
        )  # fmt: skip
    return motion.model_copy(
        update={
            "seconds": sum(summary.seconds for summary in having.values()),
            "segments": sum(summary.segments for summary in having.values()),
            "takes": len(having),
            "exemplar": exemplar,
        }
    )


def _write(pipe: Pipeline, record: CollectionRecord, put: Iterable[TakeRecord], gone: Iterable[str]) -> None:
    identifier = record.id
    pipe.set(redis_keys.collection_key(identifier), record.model_dump_json())
    pipe.zadd(redis_keys.COLLECTIONS_KEY, {identifier: record.updated})
    for take in put:
        pipe.hset(redis_keys.collection_takes_key(identifier), take.animation, take.model_dump_json())
        entry = summarise_take(take).model_dump_json()
        pipe.hset(redis_keys.collection_entries_key(identifier), take.animation, entry)
        pipe.zadd(redis_keys.collection_order_key(identifier), {take.animation: take.added})
        pipe.sadd(redis_keys.collected_key(take.animation), identifier)
        if take.status == "waiting":
            pipe.sadd(redis_keys.awaiting_key(take.segmentation), identifier)
    for animation in gone:
        pipe.hdel(redis_keys.collection_takes_key(identifier), animation)
        pipe.hdel(redis_keys.collection_entries_key(identifier), animation)
        pipe.zrem(redis_keys.collection_order_key(identifier), animation)
        pipe.srem(redis_keys.collected_key(animation), identifier)
        pipe.set(redis_keys.DELETED_KEY, b"1")
    pipe.publish(redis_keys.channel(identifier), b"collection")
