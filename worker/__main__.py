"""`python -m caesura.worker`: take jobs from Redis until a signal ends it.

python -m caesura.worker                                    one worker for everything, one for `cut` alone
python -m caesura.worker --queues cut                       one worker, for `cut` alone
python -m caesura.worker --queues analyse,cut --queues cut  one process for each
python -m caesura.worker --check                            exit status 0 where a worker of this machine is alive
"""

import argparse
import gc
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from redis.exceptions import RedisError

from caesura.worker import logs
from caesura.worker.private_folder import make_private
from caesura.worker.process.rq_worker import CaesuraWorker
from caesura.worker.process.worker_pool import WorkerPool
from caesura.worker.process.worker_registry import has_live_worker_here
from caesura.worker.queue.auxiliary_jobs import submit_sweep_if_due
from caesura.worker.queue.jobs import Jobs
from caesura.worker.queue.orphaned_jobs import OrphanedJobWatch
from caesura.worker.queue.queues import QUEUES
from caesura.worker.records.connection import await_writable, connect
from caesura.worker.records.storage_version import LayoutTooNew, check_layout
from caesura.worker.settings import WorkerSettings
from caesura.worker.store.temporary_files import delete_abandoned_files

DEFAULT_GROUPS = [["analyse", "cut"], ["cut"]]


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the workers, or check them."""
    parser = argparse.ArgumentParser(
        prog="python -m caesura.worker", description="Take jobs from Redis until a signal ends it."
    )
    parser.add_argument("--queues", action="append", type=_queues, metavar="NAME,…", help="one worker; may be repeated")
    parser.add_argument("--check", action="store_true", help="exit with 0 where a worker of this machine is alive")
    options = parser.parse_args(arguments)
    settings = WorkerSettings()
    if options.check:
        sys.exit(0 if _has_live_worker(settings) else 1)
    logs.configure_logging(settings.log_format)
    try:
        run(settings, options.queues or DEFAULT_GROUPS)
    except LayoutTooNew as refused:
        sys.exit(str(refused))


def run(settings: WorkerSettings, groups: list[list[str]]) -> None:
    """Warm up on one thread, then fork the workers."""
    client = connect(settings.redis_location)
    await_writable(client)
    check_layout(client)
    make_private(settings.data_dir)
    _choose_cache(settings)
    # Only now is it settled where compiled code is kept. The tasks are loaded for the forks to have them.
    from caesura.worker import tasks  # noqa: F401, PLC0415
    from caesura.worker.process.warm_up import warm_up  # noqa: PLC0415

    warm_up()
    gc.freeze()  # what is loaded now stays: collecting it would copy the pages that the forks share
    jobs = Jobs.open(settings)
    watch = OrphanedJobWatch(jobs)

    def tend() -> None:
        watch.look()
        submit_sweep_if_due(jobs)
        delete_abandoned_files(settings.scratch_dir)

    WorkerPool(groups, lambda queues: _run_worker(queues, settings), tend, settings.stop_seconds).run()


def _run_worker(queues: list[str], settings: WorkerSettings) -> None:
    """One worker, in its own process. It leaves where Redis refuses a write; the one after it waits first."""
    from caesura.worker.tasks import prepare  # noqa: PLC0415  as in `run`

    client = connect(settings.redis_location)
    await_writable(client)
    worker = CaesuraWorker(queues, client, Jobs.open(settings), prepare)
    worker.prefork()
    worker.work(logging_level="INFO")


def _has_live_worker(settings: WorkerSettings) -> bool:
    try:
        return has_live_worker_here(connect(settings.redis_location))
    except RedisError:
        return False


def _choose_cache(settings: WorkerSettings) -> None:
    """Compiled code is kept beside the sources, or in the data folder where these may not be written."""
    if not os.access(Path(__file__).parent, os.W_OK):
        os.environ.setdefault("NUMBA_CACHE_DIR", str(settings.data_dir / "compiled"))


def _queues(text: str) -> list[str]:
    names = text.split(",")
    for name in names:
        if name not in QUEUES:
            raise argparse.ArgumentTypeError(f"there is no queue {name!r}; there are {' and '.join(QUEUES)}")
    return names


if __name__ == "__main__":
    main()
