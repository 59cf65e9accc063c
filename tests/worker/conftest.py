"""A real Redis on a Unix socket, real worker processes, real files; shared, for every test uploads its own take."""

import pytest

from caesura.worker.embedded_redis.server import EmbeddedRedis
from caesura.worker.settings import WorkerSettings
from tests.installation import Installation, Pool, take_npz


@pytest.fixture(scope="session")
def redis_url(tmp_path_factory):
    """An embedded server."""
    server = EmbeddedRedis(tmp_path_factory.mktemp("redis"))
    server.start()
    yield server.url
    server.stop()


@pytest.fixture(scope="session")
def place(redis_url, tmp_path_factory):
    """An installation with workers: one for everything, one for `cut` alone."""
    place = Installation.at(WorkerSettings(data_dir=tmp_path_factory.mktemp("data"), redis_url=redis_url))
    place.pool = Pool(place.settings)
    yield place
    place.pool.stop()
    place.redis.close()


@pytest.fixture
def idle(tmp_path):
    """An installation of its own, without workers."""
    server = EmbeddedRedis(tmp_path / "redis")
    server.start()
    idle = Installation.at(WorkerSettings(data_dir=tmp_path / "data", redis_url=server.url))
    yield idle
    idle.redis.close()
    server.stop()


@pytest.fixture(scope="session")
def take():
    """A short take of two motions."""
    return take_npz()


@pytest.fixture(scope="session")
def long_take():
    """A take that keeps a worker busy for seconds where it is measured `SLOWLY`."""
    return take_npz(order=(0, 1) * 4, seconds=8.0, rings=60)
