"""Reads that come at the same time go to Redis together."""

import asyncio

import pytest
import redis.asyncio
from redis.exceptions import RedisError

from worker.together import Together


def reading(url, use):
    async def main():
        client = redis.asyncio.Redis.from_url(url)
        together = Together(client.mget)
        try:
            return await use(client, together)
        finally:
            await together.close()
            await client.aclose()

    return asyncio.run(main())


def test_many_reads_are_few_ways(redis_url):
    """A hundred reads at once, of two keys and of none, are answered each with its own value, in two calls at most."""

    async def use(client, together):
        await client.mset({"together:a": b"1", "together:b": b"2"})
        before = (await client.info("commandstats")).get("cmdstat_mget", {"calls": 0})["calls"]
        names = ["together:a", "together:b", "together:none"] * 34
        values = await asyncio.gather(*(together.get(name) for name in names))
        after = (await client.info("commandstats"))["cmdstat_mget"]["calls"]
        return values, after - before

    values, calls = reading(redis_url, use)
    assert values == [b"1", b"2", None] * 34
    assert calls <= 2


def test_a_read_sees_what_was_written_before_it(redis_url):
    """Also where the same was asked for a moment ago."""

    async def use(client, together):
        seen = []
        for number in range(20):
            await client.set("together:n", number)
            seen.append(int(await together.get("together:n")))
        return seen

    assert reading(redis_url, use) == list(range(20))


def test_who_leaves_does_not_disturb_the_others(redis_url):
    """One of two who wait for the same value gives up; the other is answered."""

    async def use(client, together):
        await client.set("together:c", b"3")
        leaving, staying = (asyncio.create_task(together.get("together:c")) for _ in range(2))
        await asyncio.sleep(0)
        leaving.cancel()
        return await staying

    assert reading(redis_url, use) == b"3"


def test_a_fault_is_told_to_everyone_who_asked(tmp_path):
    """Where there is no Redis."""

    async def use(_, together):
        return await asyncio.gather(*(together.get("x") for _ in range(3)), return_exceptions=True)

    told = reading(f"unix://{tmp_path}/none.sock", use)
    assert all(isinstance(fault, RedisError) for fault in told)
    with pytest.raises(RedisError):
        raise told[0]
