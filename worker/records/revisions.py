"""Revisions of a result: kept beside it, in one MULTI with the number of the newest, and gone when it goes."""

import time
from collections.abc import Sequence

from pydantic import TypeAdapter
from redis.client import Pipeline

from caesura.core.revision import Edit
from caesura.core.segmentation_document import Loop
from caesura.worker.records import Records, redis_keys
from caesura.worker.records.async_records import AsyncRecords
from caesura.worker.records.record_types import RevisionRecord, SegmentationRecord

MOST_REVISIONS = 1000
SEARCH_SECONDS = 60
"""What a search for loops found is kept so long for who asked for it."""

EDITS: TypeAdapter[tuple[Edit, ...]] = TypeAdapter(tuple[Edit, ...])
LOOPS: TypeAdapter[tuple[Loop | None, ...]] = TypeAdapter(tuple[Loop | None, ...])


def add_revision(
    records: Records,
    identifier: str,
    expected: int | None,
    note: str,
    edits: Sequence[Edit],
    loops: Sequence[Loop | None] | None = None,
) -> RevisionRecord | None:
    """Keep a revision after number `expected`, which must be the newest one; None: after whichever is.

    `loops` are the best of its segments, where they were searched.

    Answers None, and keeps nothing, where another is the newest by now, where there are as many as may be, or
    where there is no result. Of two editors who both saw the same revision one is kept.
    """
    now = time.time()

    def change(record: SegmentationRecord) -> SegmentationRecord | None:
        fits = expected is None or record.revision == expected
        wanted = record.status == "done" and fits and record.revision < MOST_REVISIONS
        return record.with_changes(revision=record.revision + 1) if wanted else None

    def also(pipe: Pipeline, record: SegmentationRecord) -> None:
        head = RevisionRecord(number=record.revision, created=now, note=note)
        pipe.rpush(redis_keys.revisions_key(identifier), head.model_dump_json())
        pipe.hset(
            redis_keys.revised_key(identifier),
            str(record.revision),
            EDITS.dump_json(tuple(edits), exclude_defaults=True),
        )
        if loops is not None:
            pipe.hset(redis_keys.revised_key(identifier), _loops_field(record.revision), LOOPS.dump_json(tuple(loops)))
        pipe.zadd(redis_keys.edited_key(record.animation), {identifier: now})

    after = records.segmentations.change(identifier, change, also)
    return None if after is None else RevisionRecord(number=after.revision, created=now, note=note)


def read_edits(records: Records, identifier: str, number: int) -> tuple[Edit, ...] | None:
    """The segments of a revision, or None where there is none."""
    return _read(records.redis.hget(redis_keys.revised_key(identifier), str(number)))


def read_loops(records: Records, identifier: str, number: int) -> tuple[Loop | None, ...] | None:
    """The best loop of each segment of a revision, where they were searched, or None."""
    return _read_loops(records.redis.hget(redis_keys.revised_key(identifier), _loops_field(number)))


def keep_searched_loops(records: Records, identifier: str, token: str, loops: Sequence[Loop | None]) -> None:
    """Answer a search for loops; who asked for it waits for a change of the segmentation."""
    with records.redis.pipeline() as pipe:
        pipe.set(redis_keys.loop_search_key(token), LOOPS.dump_json(tuple(loops)), ex=SEARCH_SECONDS)
        pipe.publish(redis_keys.channel(identifier), b"loops")
        pipe.execute()


class Revisions:
    """The same as the web process reads them."""

    def __init__(self, records: AsyncRecords) -> None:
        self._redis = records.redis

    async def all(self, identifier: str) -> list[RevisionRecord]:
        """Every revision, oldest first."""
        stored = await self._redis.lrange(redis_keys.revisions_key(identifier), 0, -1)
        return [RevisionRecord.model_validate_json(one) for one in stored]

    async def one(self, identifier: str, number: int) -> tuple[RevisionRecord, tuple[Edit, ...]] | None:
        """One revision with its segments, or None where there is none."""
        async with self._redis.pipeline() as pipe:
            pipe.lindex(redis_keys.revisions_key(identifier), number - 1)
            pipe.hget(redis_keys.revised_key(identifier), str(number))
            head, edits = await pipe.execute()
        record, segments = RevisionRecord.read(head), _read(edits)
        return None if record is None or segments is None else (record, segments)

    async def loops(self, identifier: str, number: int) -> tuple[Loop | None, ...] | None:
        """The best loop of each segment of a revision, where they were searched, or None."""
        return _read_loops(await self._redis.hget(redis_keys.revised_key(identifier), _loops_field(number)))

    async def searched_loops(self, token: str) -> tuple[Loop | None, ...] | None:
        """What a search for loops has found, or None while it has not."""
        return _read_loops(await self._redis.get(redis_keys.loop_search_key(token)))


def _loops_field(number: int) -> str:
    return f"{number}:loops"


def _read_loops(stored: bytes | str | None) -> tuple[Loop | None, ...] | None:
    return None if stored is None else LOOPS.validate_json(stored)


def _read(stored: bytes | str | None) -> tuple[Edit, ...] | None:
    return None if stored is None else EDITS.validate_json(stored)
