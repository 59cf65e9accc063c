"""What Prometheus reads: this process's requests, and what Redis knows of queues, jobs, stages and the store.

What workers count is kept in Redis (`caesura.worker.records.counters`) and told by every web process alike:
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
from caesura.worker.records.connection import names

METHODS = frozenset({"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"})
LATENCY_BUCKETS = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 1, 5, 30)


class Metrics:
    """The counts of one web process."""

    def __init__(self) -> None:
        self.registry = CollectorRegistry()
        self._found: dict[tuple[str, str, int], tuple[Counter, Histogram]] = {}
        ProcessCollector(registry=self.registry)
        self._requests = Counter(
            "caesura_requests", "Answers, by call and status.", ["method", "route", "status"], registry=self.registry
        )
        self._seconds = Histogram(
            "caesura_request_seconds",
            "Time to the first byte of an answer; without those that were asked to wait.",
            ["method", "route"],
            buckets=LATENCY_BUCKETS,
            registry=self.registry,
        )

    def request(self, method: str, route: str, status: int, seconds: float | None) -> None:
        """Count an answer. What is no method and no route of ours has no name of its own: names are for ever."""
        method, route = method if method in METHODS else "other", route or "none"
        counter, histogram = self._of(method, route, status)
        counter.inc()
        if seconds is not None:
            histogram.observe(seconds)

    def _of(self, method: str, route: str, status: int) -> tuple[Counter, Histogram]:
        """Its two series, found once: the library checks names and labels anew at each call."""
        found = self._found.get((method, route, status))
        if found is None:
            series = self._requests.labels(method, route, str(status)), self._seconds.labels(method, route)
            found = self._found[method, route, status] = series
        return found

    def text(self, backend: Backend) -> bytes:
        """All of it in Prometheus's text form. Blocks: run it on a thread."""
        shared = CollectorRegistry()
        shared.register(_Shared(backend))
        return generate_latest(self.registry) + generate_latest(shared)


class _Shared(Collector):
    """What Redis and the disk tell, read at every scrape."""

    def __init__(self, backend: Backend) -> None:
        self._backend = backend

    def collect(self) -> Iterable[Metric]:
        """Gauges first, then what the workers counted."""
        redis, settings = self._backend.jobs.redis, self._backend.settings
        memory = redis.info("memory")
        stored = redis.hgetall(redis_keys.STORE_KEY)
        told = counters.read_counters(redis.hgetall(redis_keys.COUNTERS_KEY))
        yield _gauge("queue_jobs", "Jobs that wait in a queue.", "queue", self._backend.jobs.queues.depths())
        yield _gauge(
            "store_bytes",
            "Size of the blobs of a kind at the last sweep.",
            "kind",
            dict(zip(names(stored), map(int, stored.values()), strict=True)),
        )
        for name, help_, value in (
            (
                "live_segmentations",
                "Segmentations that are queued or running.",
                redis.scard(redis_keys.LIVE_SEGMENTATIONS_KEY),
            ),
            ("redis_used_bytes", "Memory that Redis uses.", memory["used_memory"]),
            ("redis_limit_bytes", "Memory that Redis may use; 0: all of its machine.", memory.get("maxmemory", 0)),
            ("disk_free_bytes", "Free on the disk of the data folder.", shutil.disk_usage(settings.data_dir).free),
        ):
            yield GaugeMetricFamily(f"caesura_{name}", help_, value=value)
        yield _counter("segmentations", "Segmentations that came into a state.", ["status", "code"], told)
        yield _counter("lost", "Attempts that were lost to a fault of the machine, and tried again.", ["code"], told)
        yield _histogram("waited", "From being queued to being begun.", "queue", told)
        yield _histogram("stage", "How long a stage of an attempt took.", "stage", told)


def _gauge(name: str, help_: str, label: str, values: dict[str, int]) -> Metric:
    family = GaugeMetricFamily(f"caesura_{name}", help_, labels=[label])
    for key, value in values.items():
        family.add_metric([key], value)
    return family


def _counter(name: str, help_: str, labels: list[str], told: "WorkerCounters") -> Metric:
    family = CounterMetricFamily(f"caesura_{name}", help_, labels=labels)
    for given, value in told.get(name, ()):
        family.add_metric([given.get(label, "") for label in labels], value)
    return family


def _histogram(name: str, help_: str, label: str, told: "WorkerCounters") -> Metric:
    """Buckets are kept one by one, and told as Prometheus wants them: each with all that are smaller."""
    family = HistogramMetricFamily(f"caesura_{name}_seconds", help_, labels=[label])
    counts: dict[str, dict[str, float]] = {}
    for given, count in told.get(f"{name}_bucket", ()):
        counts.setdefault(given[label], {})[given["le"]] = count
    sums = {given[label]: total for given, total in told.get(f"{name}_sum", ())}
    for value, kept in sorted(counts.items()):
        ends, below = [], 0.0
        for end in counters.BUCKETS:
            below += kept.get(f"{end:g}", 0.0)
            ends.append(("+Inf" if end == counters.BUCKETS[-1] else f"{end:g}", below))
        family.add_metric([value], buckets=ends, sum_value=sums.get(value, 0.0))
    return family


WorkerCounters = dict[str, list[tuple[dict[str, str], float]]]
