"""Settings, queue, records and store of a job. They are opened after the fork, for a store has threads."""

import tempfile
from dataclasses import dataclass
from functools import cache, lru_cache

from caesura.core.analysis import Analysis
from caesura.worker.queue.jobs import Jobs
from caesura.worker.settings import WorkerSettings
from caesura.worker.store.blobs import Blobs


@dataclass(frozen=True)
class WorkerContext:
    """Settings, queue and records, store."""

    settings: WorkerSettings
    jobs: Jobs
    blobs: Blobs


@cache
def worker_context() -> WorkerContext:
    """The place of this process."""
    settings = WorkerSettings()
    tempfile.tempdir = str(settings.scratch_dir)  # a reader's copy of its file: elsewhere may be memory
    return WorkerContext(settings, Jobs.open(settings), Blobs.open(settings.store_location, settings.scratch_dir))


@lru_cache(maxsize=1)
def stored_analysis(key: str) -> Analysis:
    """An analysis of the store; the last one stays, with what its cuts have in common: a slider asks again."""
    return Analysis.from_bytes(worker_context().blobs.read(key))
