"""`python -m caesura.worker`: workers that can be asked after, that come back, and that end together."""

import os
import signal
import subprocess
import sys

from caesura.worker.settings import WorkerSettings
from tests.installation import descendants


def check(settings):
    command = [sys.executable, "-m", "caesura.worker", "--check"]
    return subprocess.run(command, env={**os.environ, **settings.environment()}, check=False, timeout=60).returncode


def workers(pool):
    return [pid for depth, pid in descendants(pool.process.pid) if depth == 1]


def test_check_tells_whether_workers_live(place, idle, take):
    """Exit status 0 where a worker of this machine gave a sign of life, 1 where none did or Redis is away."""
    place.ended(place.submit(place.upload(take)).id)
    assert check(place.settings) == 0
    assert check(idle.settings) == 1
    assert check(WorkerSettings(redis_url="unix:///nowhere/redis.sock")) == 1


def test_a_worker_that_is_killed_comes_back(place, take):
    """Both workers gone at once: two others take the next job."""
    place.ended(place.submit(place.upload(take)).id)
    killed = workers(place.pool)
    assert len(killed) == 2
    for pid in killed:
        os.kill(pid, signal.SIGKILL)
    assert place.ended(place.submit(place.upload(take)).id).status == "done"
    assert not set(workers(place.pool)) & set(killed)
