"""Webhooks: the addresses to call once a segmentation is over, and the calls that are still to be made.

An address waits with its segmentation. The very MULTI that ends the segmentation makes a delivery of each, with a
place in the list of those that are due. A delivery leaves that list when it is made, or given up.
"""

import time
from collections.abc import Iterable

import redis
from redis.client import Pipeline

from caesura.worker.records import content_ids, redis_keys
from caesura.worker.records.connection import decode_names, transact
from caesura.worker.records.record_types import DeliveryRecord, SegmentationRecord

MOST_CALLBACKS = 10
"""Addresses of one segmentation."""


def waiting_callbacks(pipe: Pipeline, segmentation: str) -> list[str]:
    """The addresses that wait, read before a MULTI whose transaction watches `callbacks_key`."""
    return sorted(decode_names(pipe.smembers(redis_keys.callbacks_key(segmentation))))


def put_deliveries(pipe: Pipeline, record: SegmentationRecord, urls: Iterable[str]) -> None:
    """In the MULTI that ends a segmentation: one delivery for each address, due now."""
    now = time.time()
    for url in urls:
        delivery = DeliveryRecord(
            id=content_ids.random_token(),
            owner=record.owner,
            url=url,
            segmentation=record.id,
            animation=record.animation,
            status=record.status,
            problem=record.problem,
            finished=record.finished or now,
        )
        pipe.set(redis_keys.delivery_key(delivery.id), delivery.model_dump_json())
        pipe.zadd(redis_keys.DELIVERIES_KEY, {delivery.id: now})
    pipe.delete(redis_keys.callbacks_key(record.id))
    pipe.publish(redis_keys.DELIVERIES_CHANNEL, b"due")


def add_callback(client: redis.Redis, segmentation: str, url: str) -> bool:
    """Have an address called once a segmentation is over, at once where it is; False where it has too many."""
    record_key, waiting_key = redis_keys.segmentation_key(segmentation), redis_keys.callbacks_key(segmentation)

    def write(pipe: Pipeline) -> bool:
        record = SegmentationRecord.read(pipe.get(record_key))
        waiting = waiting_callbacks(pipe, segmentation)
        pipe.multi()
        if record is not None and not record.live:
            put_deliveries(pipe, record, [url])
        elif record is not None and url not in waiting:
            if len(waiting) >= MOST_CALLBACKS:
                return False
            pipe.sadd(waiting_key, url)
        return True

    return transact(client, write, record_key, waiting_key)
