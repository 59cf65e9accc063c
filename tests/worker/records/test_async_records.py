"""How the web process waits: woken at once, and never for longer than asked."""

import asyncio
import time
from contextlib import aclosing

from caesura.worker.records.async_records import AsyncRecords


def reading(idle, use):
    async def main():
        records = AsyncRecords(idle.settings.redis_location)
        try:
            return await use(records)
        finally:
            await records.close()

    return asyncio.run(main())


async def once(look, is_right):
    """What is seen as soon as it is right; after ten seconds, what is seen."""
    for _ in range(200):
        seen = await look()
        if is_right(seen):
            break
        await asyncio.sleep(0.05)
    return seen


async def heard_channels(records, *counts):
    """How many channels somebody listens to, once it is one of these numbers."""

    async def look():
        return len(await records.redis.pubsub_channels("caesura:changed:?*"))

    return await once(look, lambda heard: heard in counts)


async def reads(records):
    """How often anything was read."""
    return (await records.redis.info("commandstats")).get("cmdstat_get", {"calls": 0})["calls"]


def test_waiting_is_woken_by_the_change(idle, take):
    """A cancelled job is told at once, not at the next look."""
    record = idle.submit(idle.upload(take))

    async def use(records):
        waiting = asyncio.create_task(records.wait_until_ended(record.id))
        await heard_channels(records, 1)
        await asyncio.to_thread(idle.jobs.cancel, record.id)
        began = time.monotonic()
        return await waiting, time.monotonic() - began

    told, seconds = reading(idle, use)
    assert told.status == "cancelled"
    assert seconds < 1


def test_waiting_sleeps_through_progress(idle, take):
    """What runs tells five times a second how far it is; who waits for its end reads twice: at first, and then."""
    record = idle.submit(idle.upload(take))

    async def use(records):
        asleep = await reads(records)
        waiting = asyncio.create_task(records.wait_until_ended(record.id))
        before = await once(lambda: reads(records), lambda count: count > asleep)
        idle.records.attempts.begin(record.id, record.token)
        for number in range(9):
            idle.records.attempts.change(record.id, record.token, stage="strain", fraction=number / 10)
        idle.records.attempts.fail(record.id, record.token, {"kind": "input", "code": "no-motion", "detail": ""})
        told = await waiting
        return told.status, await reads(records) - before

    of_changes = 1 + 9 + 1
    assert reading(idle, use) == ("failed", of_changes + 1)


def test_all_who_wait_listen_on_one_connection(idle, take):
    """However many there are; who leaves leaves the channel too."""
    waited = [idle.submit(idle.upload(take)) for _ in range(5)]

    async def use(records):
        waiting = [asyncio.create_task(records.wait_until_ended(record.id)) for record in waited * 4]
        heard = await heard_channels(records, 5)
        listening = [one for one in await records.redis.client_list() if int(one["sub"])]
        for record in waited:
            await asyncio.to_thread(idle.jobs.cancel, record.id)
        told = await asyncio.gather(*waiting)
        late = asyncio.create_task(records.wait_until_ended("nobody's"))
        await late
        left = await heard_channels(records, 0, 1)
        return heard, len(listening), {record.status for record in told}, left

    heard, listening, told, left = reading(idle, use)
    assert (heard, listening, told) == (5, 1, {"cancelled"})
    assert left <= 1


def test_waiting_outlives_a_broken_connection(idle, take):
    """Every connection is cut, also the one that listens: the change after it is heard all the same."""
    record = idle.submit(idle.upload(take))

    async def use(records):
        waiting = asyncio.create_task(records.wait_until_ended(record.id))
        await heard_channels(records, 1)
        for one in await records.redis.client_list():
            if int(one["sub"]):
                await records.redis.client_kill_filter(_id=one["id"])
        await asyncio.sleep(0.2)
        await asyncio.to_thread(idle.jobs.cancel, record.id)
        return await asyncio.wait_for(waiting, 10)

    assert reading(idle, use).status == "cancelled"


def test_changes_end_with_the_record(idle, take):
    """Every change is told, and None after the last."""
    record = idle.submit(idle.upload(take))

    async def use(records):
        told = []
        async with aclosing(records.follow_changes(record.id)) as changes:
            async for seen in changes:
                told.append(seen and seen.status)
                if seen is None:
                    break
                await asyncio.to_thread(idle.jobs.delete, record.id)
        return told

    told = reading(idle, use)
    assert (told[0], told[-1]) == ("queued", None)


def test_lists_are_newest_first(idle, take):
    """And go on before the last one seen."""
    uploaded = [idle.upload(take) for _ in range(3)]
    newest = sorted(uploaded, key=lambda record: record.created)[::-1]

    async def use(records):
        first = await records.animations("", 2)
        return first, await records.animations("", 2, before=first[-1].created)

    assert reading(idle, use) == (newest[:2], newest[2:])
