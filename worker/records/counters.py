"""What workers count, kept in Redis: they come and go, so only there can it be added up.

One hash holds all. A field is a name and its labels, `stage_bucket|stage=strain|le=1`. A change of a record is counted
in the very MULTI that makes it, so that nothing is counted twice and nothing is missed.
"""

import math
from collections.abc import Mapping
from typing import Any

from redis import Redis
from redis.client import Pipeline

from caesura.worker.records import redis_keys
from caesura.worker.records.schema import SegmentationRecord

BUCKETS = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, math.inf)
"""Upper ends of the buckets that durations are counted in, in seconds."""


def count_change(pipe: Pipeline, before: SegmentationRecord | None, after: SegmentationRecord) -> None:
    """A segmentation that came into another state, and how long it had waited where it is begun."""
    if before is not None and (before.status, before.token) == (after.status, after.token):
        return
    code = str((after.problem or {}).get("code", ""))
    pipe.hincrby(redis_keys.COUNTERS_KEY, counter_field("segmentations", status=after.status, code=code), 1)
    if before is not None and after.status == "running":
        count_observation(pipe, "waited", max(after.updated - before.updated, 0.0), queue=after.queue)


def count_lost(pipe: Pipeline, code: str) -> None:
    """An attempt that was lost, and why."""
    pipe.hincrby(redis_keys.COUNTERS_KEY, counter_field("lost", code=code), 1)


def count_stages(client: Redis, seconds: Mapping[str, float]) -> None:
    """How long each stage of an attempt took."""
    if not seconds:
        return
    with client.pipeline(transaction=False) as pipe:
        for stage, took in seconds.items():
            count_observation(pipe, "stage", took, stage=stage)
        pipe.execute()


def count_observation(pipe: Pipeline, name: str, seconds: float, **labels: str) -> None:
    """One duration: into its bucket, and to the sum."""
    bucket = next(end for end in BUCKETS if seconds <= end)
    pipe.hincrby(redis_keys.COUNTERS_KEY, counter_field(f"{name}_bucket", **labels, le=f"{bucket:g}"), 1)
    pipe.hincrbyfloat(redis_keys.COUNTERS_KEY, counter_field(f"{name}_sum", **labels), seconds)


def counter_field(name: str, **labels: str) -> str:
    """A name and its labels as one field."""
    return "|".join([name, *(f"{label}={value}" for label, value in labels.items())])


def read_counters(stored: Mapping[Any, Any]) -> dict[str, list[tuple[dict[str, str], float]]]:
    """The hash as Redis answers it: the values of each name, with their labels."""
    told: dict[str, list[tuple[dict[str, str], float]]] = {}
    for kept, value in stored.items():
        name, *labels = (kept.decode() if isinstance(kept, bytes) else kept).split("|")
        told.setdefault(name, []).append((dict(label.split("=", 1) for label in labels), float(value)))
    return told
