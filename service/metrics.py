"""What Prometheus reads: this process's requests, and what Redis knows of queues, jobs, stages and the store.

What workers count is kept in Redis (`caesura.worker.records.counters`) and every web process reports the same:
take `max` over
several, not `sum`. Requests are each process's own: those are summed.
"""

import shutil
from collections.abc import Iterable

from prometheus_client import CollectorRegistry, Counter, Histogram, ProcessCollector, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily, Metric
from prometheus_client.registry import Collector

from caesura.service.backend import Backend
from caesura.worker.records import counters, redis_keys
from caesura.worker.records.connection import decode_names

METHODS = frozenset({"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"})
LATENCY_BUCKETS = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 1, 5, 30)


class Metrics:
    """The counts of one web process."""

    def __init__(self) -> None:
        self.registry = CollectorRegistry()
        self._found: dict[tuple[str, str, int], tuple[Counter, Histogram]] = {}
        ProcessCollector(registry=self.registry)
        self._requests = Counter(
            "caesura_requests", "Responses by route and status.", ["method", "route", "status"], registry=self.registry
        )
        self._seconds = Histogram(
            "caesura_request_seconds",
            "Seconds to the first byte of a response, except responses to Prefer: wait.",
            ["method", "route"],
            buckets=LATENCY_BUCKETS,
            registry=self.registry,
        )

    def request(self, method: str, route: str, status: int, seconds: float | None) -> None:
        """Count an answer. What is no method and no route of ours has no name of its own: names are for ever."""
        method, route = method if method in METHODS else "other", route or "none"
        counter, histogram = self._series(method, route, status)
        counter.inc()
        if seconds is not None:
            histogram.observe(seconds)

    def _series(self, method: str, route: str, status: int) -> tuple[Counter, Histogram]:
        """Its two series, found once: the library checks names and labels anew at each call."""
        found = self._found.get((method, route, status))
        if found is None:
            series = self._requests.labels(method, route, str(status)), self._seconds.labels(method, route)
            found = self._found[method, route, status] = series
        return found

    def text(self, backend: Backend) -> bytes:
        """All of it in Prometheus's text form. Blocks: run it on a thread."""
        shared = CollectorRegistry()
        shared.register(_SharedMetrics(backend))
        return generate_latest(self.registry) + generate_latest(shared)


class _SharedMetrics(Collector):
    """Metrics of Redis and the disk, read at every scrape."""

    def __init__(self, backend: Backend) -> None:
        self._backend = backend

    def collect(self) -> Iterable[Metric]:
        """Gauges first, then what the workers counted."""
        redis, settings = self._backend.jobs.redis, self._backend.settings
        memory = redis.info("memory")
        stored = redis.hgetall(redis_keys.STORE_KEY)
        worker_counters = counters.read_counters(redis.hgetall(redis_keys.COUNTERS_KEY))
        yield _gauge("queue_jobs", "Jobs waiting in a queue.", "queue", self._backend.jobs.queues.depths())
        yield _gauge(
            "store_bytes",
            "Bytes of stored files by kind, at the last sweep.",
            "kind",
            dict(zip(decode_names(stored), map(int, stored.values()), strict=True)),
        )
        for name, help_, value in (
            (
                "live_segmentations",
                "Segmentations queued or running.",
                redis.scard(redis_keys.LIVE_SEGMENTATIONS_KEY),
            ),
            ("redis_used_bytes", "Memory used by Redis.", memory["used_memory"]),
            ("redis_limit_bytes", "Memory limit of Redis; 0: no limit.", memory.get("maxmemory", 0)),
            (
                "disk_free_bytes",
                "Free bytes on the disk of the data folder.",
                shutil.disk_usage(settings.data_dir).free,
            ),
        ):
            yield GaugeMetricFamily(f"caesura_{name}", help_, value=value)
        yield _counter("segmentations", "Segmentations by the state they reached.", ["status", "code"], worker_counters)
        yield _counter("lost", "Attempts lost to a fault of the machine and tried again.", ["code"], worker_counters)
        yield _counter("webhooks", "Webhooks by what became of a call.", ["outcome"], worker_counters)
        yield _histogram("waited", "Seconds from queued to started.", "queue", worker_counters)
        yield _histogram("stage", "Seconds of a stage of an attempt.", "stage", worker_counters)


def _gauge(name: str, help_: str, label: str, values: dict[str, int]) -> Metric:
    family = GaugeMetricFamily(f"caesura_{name}", help_, labels=[label])
    for key, value in values.items():
        family.add_metric([key], value)
    return family


def _counter(name: str, help_: str, labels: list[str], worker_counters: "WorkerCounters") -> Metric:
    family = CounterMetricFamily(f"caesura_{name}", help_, labels=labels)
    for given, value in worker_counters.get(name, ()):
        family.add_metric([given.get(label, "") for label in labels], value)
    return family


def _histogram(name: str, help_: str, label: str, worker_counters: "WorkerCounters") -> Metric:
    """A histogram with cumulative buckets, from counts of single buckets."""
    family = HistogramMetricFamily(f"caesura_{name}_seconds", help_, labels=[label])
    counts: dict[str, dict[str, float]] = {}
    for given, count in worker_counters.get(f"{name}_bucket", ()):
        counts.setdefault(given[label], {})[given["le"]] = count
    sums = {given[label]: total for given, total in worker_counters.get(f"{name}_sum", ())}
    for value, kept in sorted(counts.items()):
        ends, below = [], 0.0
        for end in counters.BUCKETS:
            below += kept.get(f"{end:g}", 0.0)
            ends.append(("+Inf" if end == counters.BUCKETS[-1] else f"{end:g}", below))
        family.add_metric([value], buckets=ends, sum_value=sums.get(value, 0.0))
    return family


WorkerCounters = dict[str, list[tuple[dict[str, str], float]]]
