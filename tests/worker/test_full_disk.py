"""Workers on a disk that fills to the last byte: they wait until it has room, and go on."""

import time

import pytest

from benchmarks.chaos.disk import small_disk
from caesura.worker.embedded_redis.server import EmbeddedRedis
from caesura.worker.records.connection import await_writable
from caesura.worker.settings import WorkerSettings
from tests.conftest import unavailable
from tests.installation import Installation, Pool, descendants

FULL_SECONDS = 5.0


@pytest.fixture
def disk(tmp_path):
    """A disk of 16 MB."""
    try:
        with small_disk(tmp_path / "disk", 2**24) as disk:
            yield disk
    except PermissionError as refused:
        unavailable(str(refused))


@pytest.fixture
def place(disk):
    """An installation with its Redis, its store and two workers on the small disk."""
    server = EmbeddedRedis(disk.folder / "redis")
    server.start()
    place = Installation.at(WorkerSettings(data_dir=disk.folder, redis_url=server.url))
    place.pool = Pool(place.settings)
    yield place
    disk.empty()
    place.pool.stop()
    place.redis.close()
    server.stop()


def test_workers_wait_while_redis_takes_no_writes(place, disk, take):
    """Each leaves once at most, and not every second; new work is done once there is room."""
    assert place.ended(place.submit(place.upload(take)).id).status == "done"
    disk.fill()
    seen, deadline = set(), time.monotonic() + FULL_SECONDS
    while time.monotonic() < deadline:
        seen |= {pid for depth, pid in descendants(place.pool.process.pid) if depth == 1}
        time.sleep(0.05)
    disk.empty()
    assert len(seen) <= 4  # two, and one after each
    await_writable(place.redis, 20.0)
    assert place.ended(place.submit(place.upload(take)).id).status == "done"
