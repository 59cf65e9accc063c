"""Whoever can write to Redis may forge a job: it runs nothing that is not the project's own."""

import os
import subprocess
import sys

import pytest
from rq import Callback
from rq import Queue as RqQueue
from rq.serializers import JSONSerializer

WORKER = """
from caesura.worker.records.connection import connect
from caesura.worker.process.rq_worker import CaesuraWorker
from caesura.worker.queue.jobs import Jobs
from caesura.worker.settings import WorkerSettings
settings = WorkerSettings()
CaesuraWorker(["cut"], connect(settings.redis_location), Jobs.open(settings)).work(burst=True)
"""

FORGED = "import os, pathlib\ndef mark(*_): pathlib.Path(os.environ['MARK']).touch()\n"


@pytest.fixture
def work(idle, tmp_path):
    """A worker that does all that waits on `cut`, and could import the attacker's code; whether that has run."""
    (tmp_path / "forged.py").write_text(FORGED)
    mark = tmp_path / "mark"
    path = f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}"
    environment = {**os.environ, **idle.settings.environment(), "PYTHONPATH": path, "MARK": str(mark)}

    def run():
        subprocess.run([sys.executable, "-c", WORKER], env=environment, check=True, timeout=60)
        return mark.exists()

    return run


def test_a_job_that_names_another_function_is_not_run(idle, work, tmp_path):
    """`os.system`, or whatever can be imported, or RQ's pickles, which run code as they are read."""
    queue = RqQueue("cut", connection=idle.redis, serializer=JSONSerializer)
    queue.enqueue("os.system", f"touch {tmp_path / 'mark'}")
    queue.enqueue("forged.mark")
    RqQueue("cut", connection=idle.redis).enqueue("forged.mark")
    assert not work()
    assert idle.jobs.queues.depths()["cut"] == 0


def test_a_task_of_ours_calls_nobody_back(idle, work):
    """The first ends well and the second does not; both name a function for each end."""
    called = Callback("forged.mark")
    queue = RqQueue("cut", connection=idle.redis, serializer=JSONSerializer)
    for task in ("run_cut", "run_export"):
        arguments = [f"caesura.worker.tasks.{task}", "nothing", "?revision=none"]
        queue.enqueue(*arguments, on_success=called, on_failure=called, on_stopped=called)
    assert not work()
    assert [queue.finished_job_registry.count, queue.failed_job_registry.count] == [1, 1]
