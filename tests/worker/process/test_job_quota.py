"""A job that takes more than its share ends alone; and how many threads a share is."""

import shutil
import signal
import subprocess
import sys

from caesura.worker.process.thread_count import available_threads

MEMORY = """
from caesura.worker.process.job_quota import JobQuota
allowance = JobQuota(64 * 2**20, 60)
held = bytearray(32 * 2**20)
try:
    more = bytearray(64 * 2**20)
except MemoryError:
    allowance.extend(64 * 2**20)
    more = bytearray(64 * 2**20)
    print("granted")
"""
TIME = """
from caesura.worker.process import job_quota as allowance
allowance.GRACE_SECONDS = 0
allowance.JobQuota(2**30, 1)
while True:
    pass
"""


def run(program):
    command = [sys.executable, "-c", program]
    return subprocess.run(command, check=False, capture_output=True, text=True, timeout=60)


def test_memory_is_bounded_and_can_be_granted():
    """Over the bound is a MemoryError, which a job answers for; a mapped file makes room for itself."""
    assert run(MEMORY).stdout == "granted\n"


def test_processor_time_is_bounded():
    """The kernel ends what computes for ever."""
    assert run(TIME).returncode == -signal.SIGXCPU


def test_the_quota_bounds_the_threads(tmp_path):
    """Of the cgroup's second version, of its first, or of none."""
    allowed = available_threads(tmp_path)
    assert allowed >= 1
    (tmp_path / "cpu").mkdir()
    (tmp_path / "cpu" / "cpu.cfs_quota_us").write_text("50000\n")
    (tmp_path / "cpu" / "cpu.cfs_period_us").write_text("100000\n")
    assert available_threads(tmp_path) == 1
    shutil.rmtree(tmp_path / "cpu")
    (tmp_path / "cpu.max").write_text("max 100000\n")
    assert available_threads(tmp_path) == allowed
    (tmp_path / "cpu.max").write_text("100000 100000\n")
    assert available_threads(tmp_path) == 1
