"""One installation as tests see it: a Redis, a store, worker processes, and what a service would ask of them."""

import io
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import redis

from caesura.core.parameters import ALGORITHM, Parameters
from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import Records, content_ids
from caesura.worker.records.connection import connect
from caesura.worker.records.schema import AnimationRecord, Part, SegmentationRecord
from caesura.worker.settings import WorkerSettings
from caesura.worker.store.blobs import Blobs
from tests.animations import performing_bar

SECRET = b"of the tests"

SLOWLY = {"descriptor": "heat-kernel"}
"""Parameters that keep a worker busy with every frame: a take of a minute for seconds, on a fast machine too."""


def take_npz(order=(0, 1, 0), seconds=2.0, rings=8):
    """The bytes of an NPZ: the performing bar, 60 frames a motion."""
    animation = performing_bar(order, seconds=seconds, rings=rings).animation
    vertices = np.array(animation.vertices(0, animation.frames))
    out = io.BytesIO()
    np.savez(out, vertices=vertices, triangles=animation.triangles, frame_rate=np.float64(30))
    return out.getvalue()


@dataclass
class Installation:
    """What a web process would hold."""

    settings: WorkerSettings
    redis: redis.Redis
    records: Records
    jobs: Jobs
    blobs: Blobs
    pool: "Pool | None" = None

    @classmethod
    def at(cls, settings):
        client = connect(settings.redis_location)
        jobs = Jobs(client, settings.attempts, settings.job_seconds)
        return cls(settings, client, jobs.records, jobs, Blobs.open(settings.store_location, settings.scratch_dir))

    def upload(self, content):
        """A new animation, even of the same bytes."""
        key = self.blobs.put(content, "uploads")
        identifier = content_ids.animation_id(SECRET, "", [("take", len(content), key)])
        part = Part(name="take", key=key, bytes=len(content))
        record = AnimationRecord(id=identifier, name="take", format="npz", parts=(part,), created=time.time())
        return self.records.animations.add(record)[0]

    def wanted(self, animation, method="joint-entropy", **given):
        parameters = Parameters(method=method, **given)
        now = time.time()
        return SegmentationRecord(
            id=content_ids.segmentation_id(SECRET, animation.id, parameters.canonical(), ALGORITHM),
            animation=animation.id,
            parameters=parameters.model_dump(),
            algorithm=ALGORITHM,
            created=now,
            updated=now,
        )

    def submit(self, animation, **given):
        return self.jobs.submit(self.wanted(animation, **given))

    def until(self, identifier, reached, seconds=60.0):
        """The record once `reached(record)` holds."""
        deadline = time.monotonic() + seconds
        while True:
            record = self.records.segmentations.one(identifier)
            if record is not None and reached(record):
                return record
            assert time.monotonic() < deadline, record
            time.sleep(0.005)

    def ended(self, identifier, seconds=60.0):
        """The record once it is neither queued nor running."""
        return self.until(identifier, lambda record: not record.live, seconds)

    def begun(self, identifier, seconds=60.0):
        """The record once it runs and has told a stage."""
        return self.until(identifier, lambda record: record.status == "running" and record.stage, seconds)


class Pool:
    """`python -m caesura.worker` in a process of its own."""

    def __init__(self, settings, *arguments):
        environment = {**os.environ, **settings.environment()}
        command = [sys.executable, "-m", "caesura.worker", *arguments]
        self.process = subprocess.Popen(command, env=environment, start_new_session=True)

    def stop(self):
        """SIGTERM; the exit status."""
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(30)


def descendants(pid):
    """Every process below, with its depth, as the system tells; threads and processes may end while we look."""
    below = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        with suppress(FileNotFoundError, ProcessLookupError):
            for child in map(int, task.read_text().split()):
                below += [(1, child), *((depth + 1, far) for depth, far in descendants(child))]
    return below


def alive(pid):
    """Whether a process is there, and not only its exit status."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
    except (FileNotFoundError, ProcessLookupError):
        return False
