"""How the web process waits: woken at once, and never for longer than asked."""

import asyncio
import time
from contextlib import aclosing

from worker.async_records import AsyncRecords


def reading(idle, use):
    async def main():
        records = AsyncRecords(idle.settings.redis_location)
        try:
            return await use(records)
        finally:
            await records.close()

    return asyncio.run(main())


def test_waiting_is_woken_by_the_change(idle, take):
    """A cancelled job is told at once, not at the next look."""
    record = idle.submit(idle.upload(take))

    async def use(records):
        waiting = asyncio.create_task(records.wait(record.id, 10))
        await asyncio.sleep(0.2)
        await asyncio.to_thread(idle.jobs.cancel, record.id)
        began = time.monotonic()
        return await waiting, time.monotonic() - began

    told, seconds = reading(idle, use)
    assert told.status == "cancelled"
    assert seconds < 1


def test_waiting_ends_when_asked(idle, take):
    """Nothing changes: after the time given, the record as it is."""
    record = idle.submit(idle.upload(take))
    assert reading(idle, lambda records: records.wait(record.id, 0.2)) == record


def test_changes_end_with_the_record(idle, take):
    """Every change is told, and None after the last."""
    record = idle.submit(idle.upload(take))

    async def use(records):
        told = []
        async with aclosing(records.changes(record.id)) as changes:
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
