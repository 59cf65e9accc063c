"""Calls that are due. Any number of web processes claim from one list; a claim that nobody fulfils is due again."""

import time

from caesura.worker.records import counters, redis_keys
from caesura.worker.records.async_records import AsyncRecords
from caesura.worker.records.connection import decode_names
from caesura.worker.records.record_types import DeliveryRecord

CLAIM_SECONDS = 60.0
"""After which a call is due again whose process was killed: longer than any call takes."""

MOST_FAILURES = 13
FIRST_PAUSE_SECONDS, PAUSE_GROWTH, LONGEST_PAUSE_SECONDS = 2.0, 2.0, 3600.0
"""Thirteen calls within some two hours."""

CLAIM = """
local due = redis.call('ZRANGEBYSCORE', KEYS[1], '-inf', ARGV[1], 'LIMIT', 0, ARGV[3])
if #due == 0 then due = redis.call('ZRANGEBYSCORE', KEYS[1], '(' .. ARGV[4], '+inf', 'LIMIT', 0, ARGV[3]) end
for _, id in ipairs(due) do redis.call('ZADD', KEYS[1], ARGV[2], id) end
return due
"""
"""What is due, and what waits longer than any pause is: a clock had jumped ahead then."""


def pause_seconds(failures: int) -> float:
    """How long to wait after so many failures: 2 s, 4 s, 8 s, …, at most an hour."""
    return min(FIRST_PAUSE_SECONDS * PAUSE_GROWTH ** (failures - 1), LONGEST_PAUSE_SECONDS)


class DeliveryQueue:
    """The list, as a web process claims from it."""

    def __init__(self, records: AsyncRecords) -> None:
        self._redis = records.redis

    async def claim(self, most: int) -> list[DeliveryRecord]:
        """At most so many that are due, for this process alone."""
        now = time.time()
        latest = now + LONGEST_PAUSE_SECONDS + CLAIM_SECONDS
        given = [repr(now), repr(now + CLAIM_SECONDS), str(most), repr(latest)]
        ids = decode_names(await self._redis.register_script(CLAIM)([redis_keys.DELIVERIES_KEY], given))
        stored = await self._redis.mget([redis_keys.delivery_key(one) for one in ids]) if ids else []
        found = [DeliveryRecord.read(one) for one in stored]
        gone = [one for one, record in zip(ids, found, strict=True) if record is None]
        if gone:
            await self._redis.zrem(redis_keys.DELIVERIES_KEY, *gone)
        return [record for record in found if record is not None]

    async def next_due(self) -> float | None:
        """Seconds until the next one is due; None without any."""
        first = await self._redis.zrange(redis_keys.DELIVERIES_KEY, 0, 0, withscores=True)
        return max(0.0, float(first[0][1]) - time.time()) if first else None

    async def end(self, delivery: DeliveryRecord, outcome: str) -> None:
        """Forget a call that was made, or given up."""
        async with self._redis.pipeline() as pipe:
            pipe.delete(redis_keys.delivery_key(delivery.id))
            pipe.zrem(redis_keys.DELIVERIES_KEY, delivery.id)
            pipe.hincrby(redis_keys.COUNTERS_KEY, counters.counter_field("webhooks", outcome=outcome), 1)
            await pipe.execute()

    async def postpone(self, delivery: DeliveryRecord) -> bool:
        """Have a call made again after a pause that grows; False, and it is given up, after the last."""
        failed = delivery.model_copy(update={"failures": delivery.failures + 1})
        if failed.failures >= MOST_FAILURES:
            await self.end(delivery, "given-up")
            return False
        async with self._redis.pipeline() as pipe:
            pipe.set(redis_keys.delivery_key(delivery.id), failed.model_dump_json(), xx=True)
            pipe.zadd(redis_keys.DELIVERIES_KEY, {delivery.id: time.time() + pause_seconds(failed.failures)}, xx=True)
            pipe.hincrby(redis_keys.COUNTERS_KEY, counters.counter_field("webhooks", outcome="failed"), 1)
            await pipe.execute()
        return True
