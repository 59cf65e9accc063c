"""Threads are those that affinity allows and that the cgroup's quota pays for, whichever is fewer."""

import os
import subprocess
import sys

import pytest

from caesura.worker.process.thread_count import available_threads

ALL = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


@pytest.fixture
def machine(tmp_path):
    """Makes the files of a cgroup's quota, and of where this process is in the tree of them."""

    def make(files, own="0::/\n"):
        for name, content in files.items():
            path = tmp_path / "cgroup" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content)
        (tmp_path / "own").write_text(own)
        return tmp_path / "cgroup", tmp_path / "own"

    return make


@pytest.mark.parametrize(
    ("files", "own", "quota"),
    [
        ({}, "", None),
        ({"cpu.max": "max 100000\n"}, "0::/\n", None),
        ({"cpu.max": "100000 100000\n"}, "0::/\n", 1),
        ({"cpu.max": "30000 100000\n"}, "0::/\n", 1),
        ({"cpu.max": "150000 100000\n"}, "0::/\n", 2),
        ({"cpu/cpu.cfs_quota_us": "-1\n", "cpu/cpu.cfs_period_us": "100000\n"}, "3:cpu,cpuacct:/\n", None),
        ({"cpu/cpu.cfs_quota_us": "50000\n", "cpu/cpu.cfs_period_us": "100000\n"}, "3:cpu,cpuacct:/\n", 1),
        ({"system.slice/caesura.service/cpu.max": "100000 100000"}, "0::/system.slice/caesura.service\n", 1),
        ({"system.slice/cpu.max": "100000 100000"}, "0::/system.slice/caesura.service\n", 1),
        ({"cpu/docker/ab/cpu.cfs_quota_us": "1", "cpu/docker/ab/cpu.cfs_period_us": "9"}, "4:cpu:/docker/ab\n", 1),
        ({"memory/docker/cpu.max": "100000 100000"}, "4:memory:/docker\n", None),
        ({"cpu.max": "nonsense"}, "0::/\n", None),
    ],
)
def test_the_quota_bounds_the_threads(machine, files, own, quota):
    """Of cgroup v2 and v1, of this group and of those above it; rounded up, and never none."""
    assert available_threads(*machine(files, own)) == (ALL if quota is None else min(ALL, quota))


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="affinity is Linux's")
def test_affinity_bounds_the_threads():
    """A process that is held on one processor computes on one thread."""
    program = (
        "import os; from caesura.worker.process.thread_count import available_threads\n"
        "os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}); print(available_threads())"
    )
    told = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert told.stdout.strip() == "1"
