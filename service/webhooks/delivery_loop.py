"""Makes the calls that are due, some at once, for as long as the web process runs.

A call is a POST that is answered with 2xx within ten seconds; nothing of the answer but its status is read, and no
redirect is followed. Each is made at least once: a receiver knows a repeated one by its `webhook-id`.
"""

import json
import logging
import time
from datetime import UTC, datetime

import anyio
import httpcore
from anyio import move_on_after, to_thread
from anyio.abc import TaskGroup
from redis.exceptions import RedisError

from caesura.service.backend import Backend
from caesura.service.http.outgoing.address_policy import ForbiddenAddress
from caesura.service.http.outgoing.checked_connection import connection_pool
from caesura.service.webhooks.delivery_queue import DeliveryQueue
from caesura.service.webhooks.signature import signature_headers
from caesura.worker.records import content_ids, redis_keys
from caesura.worker.records.record_types import DeliveryRecord
from caesura.worker.records.subscription import Subscription

log = logging.getLogger(__name__)

CALLS_AT_ONCE = 16
CALL_SECONDS = 10.0
FAULTS = (httpcore.ProtocolError, httpcore.NetworkError, httpcore.TimeoutException, OSError, ValueError)
"""Of the network and of the receiver."""

QUIET_SECONDS = 15.0
"""Between two looks where nobody says that a call is due."""
UNREACHABLE_SECONDS = 1.0


class DeliveryLoop:
    """The calls of one web process."""

    def __init__(self, backend: Backend) -> None:
        self._backend = backend
        self._queue = DeliveryQueue(backend.records)
        self._pool = connection_pool(backend.address_policy, CALLS_AT_ONCE)
        self._running = 0

    async def run(self) -> None:
        """Until it is cancelled; where Redis does not answer it is asked again."""
        async with self._pool:
            while True:
                try:
                    async with self._backend.records.listener.subscribe(redis_keys.DELIVERIES_CHANNEL) as ear:
                        await self._follow(ear)
                except* (RedisError, OSError) as faults:
                    log.warning("webhooks wait for Redis: %s", faults.exceptions[0])
                except* Exception:  # a bug of ours: it must not end the web process
                    log.exception("webhooks begin anew")
                await anyio.sleep(UNREACHABLE_SECONDS)

    async def _follow(self, ear: Subscription) -> None:
        async with anyio.create_task_group() as calls:
            while True:
                await self._start_due(calls, ear)
                await ear.wait(await self._pause())
                await self._backend.records.listener.listen(redis_keys.DELIVERIES_CHANNEL)

    async def _pause(self) -> float:
        """Until the next one is due; with all places taken, until one of them is free."""
        if self._running >= CALLS_AT_ONCE:
            return QUIET_SECONDS
        due = await self._queue.next_due()
        return QUIET_SECONDS if due is None else min(due + 0.01, QUIET_SECONDS)

    async def _start_due(self, calls: TaskGroup, ear: Subscription) -> None:
        free = CALLS_AT_ONCE - self._running
        for delivery in await self._queue.claim(free) if free > 0 else ():
            self._running += 1
            calls.start_soon(self._call, delivery, ear)

    async def _call(self, delivery: DeliveryRecord, ear: Subscription) -> None:
        try:
            failure = await self._make(delivery)
            if not failure:
                await self._queue.end(delivery, "delivered")
            else:
                fields = {"segmentation": delivery.segmentation, "failures": delivery.failures + 1, "why": failure}
                kept = await self._queue.postpone(delivery)
                log.warning("a webhook failed" if kept else "a webhook is given up", extra={"fields": fields})
        finally:
            self._running -= 1
            ear.notify(b"free")

    async def _make(self, delivery: DeliveryRecord) -> str:
        """Why the call failed; empty where it was answered."""
        body = json.dumps(_document(delivery)).encode()
        secret = await to_thread.run_sync(lambda: self._backend.secret)
        key = content_ids.webhook_secret(secret, delivery.owner)
        headers = {
            "Content-Type": "application/json",
            "User-Agent": "Caesura",
            **signature_headers(key, delivery.id, int(time.time()), body),
        }
        with move_on_after(CALL_SECONDS):
            try:
                async with self._pool.stream(
                    "POST",
                    delivery.url,
                    headers=[(name.encode(), value.encode()) for name, value in headers.items()],
                    content=body,
                ) as answer:
                    return "" if answer.status // 100 == 2 else f"answered {answer.status}"
            except ForbiddenAddress:
                return "its address is not called"
            except FAULTS as fault:
                return type(fault).__name__
        return "no answer in time"


def _document(delivery: DeliveryRecord) -> dict[str, object]:
    """What the receiver is told."""
    finished = datetime.fromtimestamp(delivery.finished, UTC).isoformat().replace("+00:00", "Z")
    here = f"/v1/segmentations/{delivery.segmentation}"
    return {
        "type": f"segmentation.{delivery.status}",
        "timestamp": finished,
        "data": {
            "id": delivery.segmentation,
            "animation": delivery.animation,
            "status": delivery.status,
            "problem": delivery.problem,
            "finished": finished,
            "links": {"self": here, "result": f"{here}/result"},
        },
    }
