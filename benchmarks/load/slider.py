"""A new number of motions of an analysed take, HTTP to HTTP: one that was scored, and one that needs a job."""

import time

from redis import Redis

from benchmarks.load.calls import Calls
from benchmarks.load.measure import Measure, percentile
from benchmarks.load.takes import different
from caesura.samples.figures import figure
from caesura.worker.records import redis_keys

TAKES = 5
UNSCORED = 8
LOOK_SECONDS = 0.05


def analysed(calls: Calls, redis: Redis, takes: int = TAKES) -> list[tuple[str, list[int]]]:
    """Demo takes whose scored numbers of motions are stored: their animations, and those numbers."""
    files = different(figure("smooth").glb)
    found = []
    for _ in range(takes):
        status = calls.post_file(next(files))
        scores = calls.http.get(f"/v1/segmentations/{status['id']}/result.json").json()["scores"]
        while redis.hlen(redis_keys.alternatives_key(status["id"])) < len(scores):
            time.sleep(LOOK_SECONDS)
        found.append((status["animation"], [score["motions"] for score in scores]))
    return found


def stored_bytes(redis: Redis) -> tuple[int, int]:
    """Bytes of Redis's memory that one demo take's result takes, and that its alternatives take beside it."""
    key = next(redis.scan_iter(match=redis_keys.alternatives_key("*"), count=1000)).decode()
    identifier = key.rpartition(":")[2]
    parts = [redis_keys.segmentation_key(identifier), *_parts(identifier)]
    return sum(_memory(redis, part) for part in parts), _memory(redis, key)


def _parts(identifier: str) -> list[str]:
    return [redis_keys.segmentation_key(identifier, part) for part in ("document", "energy", "labels")]


def _memory(redis: Redis, key: str) -> int:
    """Bytes, counted in full."""
    used = redis.memory_usage(key, samples=0)
    return int(used) if isinstance(used, int) else 0


def slider(calls: Calls, takes: list[tuple[str, list[int]]]) -> list[Measure]:
    """Ask for every number that was scored, and for some more, one after the other."""
    stored = [_asked(calls, animation, k) for animation, scored in takes for k in scored]
    jobs = [_asked(calls, animation, max(scored) + k) for animation, scored in takes for k in range(1, UNSCORED + 1)]
    return [
        Measure("new K, scored before: median", percentile(stored, 0.5), "ms", most=50),
        Measure("new K, scored before: p95", percentile(stored, 0.95), "ms"),
        Measure("new K, by a job: median", percentile(jobs, 0.5), "ms", most=50),
        Measure("new K, by a job: p95", percentile(jobs, 0.95), "ms"),
    ]


def _asked(calls: Calls, animation: str, motions: int) -> float:
    since = time.perf_counter()
    status = calls.cut_again(animation, motions=motions)
    took = (time.perf_counter() - since) * 1000
    if status["status"] != "done":
        raise RuntimeError(f"{motions} motions: {status['status']}")
    return took
