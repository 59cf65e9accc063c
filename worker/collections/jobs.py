"""The jobs of collections, whichever way they end: what a person can mend is said in the record that asked for it."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from caesura.worker.collections.example_search import find_example
from caesura.worker.collections.proposals import work_out
from caesura.worker.collections.take_labelling import label_waiting
from caesura.worker.process.job_quota import JobQuota
from caesura.worker.process.worker_context import WorkerContext
from caesura.worker.queue.collection_jobs import fail_collection_job
from caesura.worker.queue.job_problems import INTERNAL_ERROR, problem_of
from caesura.worker.queue.queues import TimeLimit

log = logging.getLogger(__name__)


def run_labelling(here: WorkerContext, identifier: str) -> None:
    """Label what waits in a collection."""
    with _reported(here, "collect", identifier):
        label_waiting(here, identifier)


def run_proposal(here: WorkerContext, identifier: str, number: str) -> None:
    """Work a proposal out."""
    collections = here.jobs.records.collections
    record, proposal = collections.one(identifier), collections.proposal(identifier, number)
    if record is None or proposal is None or proposal.status != "working":
        return
    with _reported(here, "propose", identifier, number):
        collections.put_proposal(identifier, work_out(here, record, proposal))


def run_search(here: WorkerContext, identifier: str, number: str) -> None:
    """Search for an example."""
    collections = here.jobs.records.collections
    record, search = collections.one(identifier), collections.search(identifier, number)
    if record is None or search is None or search.status != "working":
        return
    with _reported(here, "search", identifier, number):
        found = find_example(here, record, search)
        collections.put_search(identifier, search.model_copy(update={"status": "done", "found": found}))


@contextmanager
def _reported(here: WorkerContext, task: str, *args: str) -> Iterator[None]:
    """Within the limits of a job; what it raises is said where it was asked for, and a bug is logged."""
    JobQuota(here.settings.job_memory_bytes, here.settings.job_seconds)
    try:
        yield
    except (Exception, TimeLimit) as fault:
        problem = problem_of(fault)
        if problem == INTERNAL_ERROR:
            log.exception("%s of collection %s failed", task, args[0])
        fail_collection_job(here.jobs, task, args, problem)
