"""Jobs of collections: takes that wait are labelled, a change is proposed, an example is searched for."""

from collections.abc import Sequence
from typing import Any

from caesura.worker.queue.job_problems import LOST
from caesura.worker.queue.jobs import Jobs
from caesura.worker.records import content_ids, redis_keys
from caesura.worker.records.collection_types import CollectionRecord, ProposalRecord, SearchRecord
from caesura.worker.records.collections import CollectionChange
from caesura.worker.records.record_types import Queue

LOOK_AGAIN_SECONDS = 30
"""Where takes wait and no job is known, one is submitted, at most so often."""

QUEUE_OF_TASK: dict[str, Queue] = {"collect": "analyse", "propose": "analyse", "search": "cut"}
"""All takes of a collection may be cut anew: that is for the workers that take their time."""


def submit_labelling(jobs: Jobs, identifier: str) -> None:
    """Have the takes labelled that wait in a collection, unless a job for it waits already."""
    key = redis_keys.collection_job_key(identifier)
    before = jobs.redis.get(key)
    if isinstance(before, bytes) and jobs.queues.is_waiting(QUEUE_OF_TASK["collect"], before.decode()):
        return
    token = content_ids.random_token()
    with jobs.redis.pipeline() as pipe:
        jobs.queues.put(QUEUE_OF_TASK["collect"], "collect", [identifier], token, jobs.job_seconds, pipe)
        pipe.set(key, token, ex=LOOK_AGAIN_SECONDS)
        pipe.execute()


def submit_labelling_if_lost(jobs: Jobs, identifier: str) -> None:
    """The same where no job was submitted lately: the last one may have been lost with its worker."""
    if not jobs.redis.exists(redis_keys.collection_job_key(identifier)):
        submit_labelling(jobs, identifier)


def submit_proposal(jobs: Jobs, identifier: str, proposal: ProposalRecord) -> ProposalRecord:
    """Have a proposal worked out. Raises `QueueFull`."""
    jobs.queues.check_room()
    pending = proposal.model_copy(update={"token": content_ids.random_token()})
    jobs.records.collections.put_proposal(identifier, pending)
    _put(jobs, "propose", identifier, pending)
    return pending


def submit_search(jobs: Jobs, identifier: str, search: SearchRecord) -> SearchRecord:
    """Have an example searched for, as soon as its animation is analysed. Raises `QueueFull`."""
    jobs.queues.check_room()
    pending = search.model_copy(update={"token": content_ids.random_token()})
    jobs.records.collections.put_search(identifier, pending)
    awaiting, follower = redis_keys.awaiting_key(search.segmentation), _follower(identifier, pending)
    jobs.redis.sadd(awaiting, follower)
    segmentation = jobs.records.segmentations.one(search.segmentation)
    if (segmentation is None or not segmentation.live) and jobs.redis.srem(awaiting, follower):
        _put(jobs, "search", identifier, pending)
    return pending


def _follower(identifier: str, search: SearchRecord) -> str:
    return f"{identifier} {search.id} {search.token}"


def fail_if_lost(jobs: Jobs, identifier: str, wanted: ProposalRecord | SearchRecord) -> None:
    """Say so where the job of a proposal or search neither waits nor runs any more: its worker was lost."""
    task = "propose" if isinstance(wanted, ProposalRecord) else "search"
    if jobs.records.attempts.leased(wanted.token) or jobs.queues.is_waiting(QUEUE_OF_TASK[task], wanted.token):
        return
    if isinstance(wanted, SearchRecord) and jobs.redis.sismember(
        redis_keys.awaiting_key(wanted.segmentation), _follower(identifier, wanted)
    ):
        return
    fail_collection_job(jobs, task, [identifier, wanted.id], LOST)


def fail_collection_job(jobs: Jobs, task: str, args: Sequence[str], problem: dict[str, Any]) -> None:
    """End what a job was for with a problem: a proposal, a search, or the takes that it was to label."""
    collections, (identifier, *rest) = jobs.records.collections, args
    failed = {"status": "failed", "problem": problem}
    if task == "collect":
        collections.change(identifier, lambda record: _without_waiting(jobs, record, problem))
    elif task == "propose":
        proposal = collections.proposal(identifier, rest[0])
        if proposal is not None and proposal.status == "working":
            collections.put_proposal(identifier, proposal.model_copy(update=failed))
    else:
        search = collections.search(identifier, rest[0])
        if search is not None and search.status == "working":
            collections.put_search(identifier, search.model_copy(update=failed))


def _without_waiting(jobs: Jobs, record: CollectionRecord, problem: dict[str, Any]) -> CollectionChange | None:
    """The takes that were ready to be labelled have failed; those that are still analysed go on."""
    entries = jobs.records.collections.entries(record.id)
    waiting = [animation for animation, entry in entries.items() if entry.status == "waiting"]
    failed = []
    for take in jobs.records.collections.takes(record.id, waiting):
        segmentation = jobs.records.segmentations.one(take.segmentation)
        if segmentation is None or not segmentation.live:
            failed.append(take.model_copy(update={"status": "failed", "problem": problem}))
    return CollectionChange(record, tuple(failed)) if failed else None


def _put(jobs: Jobs, task: str, identifier: str, wanted: ProposalRecord | SearchRecord) -> None:
    with jobs.redis.pipeline() as pipe:
        args = [identifier, wanted.id]
        jobs.queues.put(QUEUE_OF_TASK[task], task, args, wanted.token, jobs.job_seconds, pipe)
        jobs.records.attempts.renew(wanted.token, pipe)
        pipe.execute()
