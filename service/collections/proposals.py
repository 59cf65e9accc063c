"""Proposals: changes that a person accepts or refuses. Blocks."""

import time

from caesura.service.backend import Backend
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.collections.common_motions import add_motions
from caesura.worker.collections.corrected_takes import with_segments
from caesura.worker.queue.collection_jobs import submit_proposal
from caesura.worker.records import content_ids
from caesura.worker.records.collection_types import CollectionRecord, ProposalRecord
from caesura.worker.records.collections import CollectionChange


def propose_recut(backend: Backend, identifier: str, asked: int | None) -> ProposalRecord:
    """Have all takes cut together anew, to be looked at."""
    wanted = ProposalRecord(id=content_ids.random_token(), kind="recut", created=time.time(), asked=asked)
    return submit_proposal(backend.jobs, identifier, wanted)


def propose_correction(backend: Backend, identifier: str, animation: str) -> ProposalRecord:
    """Have it worked out what a correction of one take says of the others."""
    wanted = ProposalRecord(id=content_ids.random_token(), kind="correction", created=time.time(), animation=animation)
    return submit_proposal(backend.jobs, identifier, wanted)


def decide(backend: Backend, identifier: str, number: str, accepted: bool) -> ProposalRecord:
    """Accept a proposal, which makes its changes, or refuse it. Takes that were changed since stay as they are.

    Raises `RequestProblem` ("not-found", "not-open").
    """
    collections = backend.jobs.records.collections
    proposal = collections.proposal(identifier, number)
    if proposal is None:
        raise RequestProblem("not-found", f"The collection has no proposal {number}.")
    if proposal.status != "open":
        raise RequestProblem("not-open", f"The proposal is {proposal.status}: it is not to be decided.")
    if accepted:
        _apply(backend, identifier, proposal)
    decided = proposal.model_copy(update={"status": "accepted" if accepted else "refused"})
    collections.put_proposal(identifier, decided)
    return decided


def _apply(backend: Backend, identifier: str, proposal: ProposalRecord) -> None:
    collections = backend.jobs.records.collections
    wanted = {change.animation: change for change in proposal.changes}

    def change(record: CollectionRecord) -> CollectionChange:
        present = {take.animation: take for take in collections.takes(identifier, wanted)}
        put = tuple(
            with_segments(take, wanted[animation].segments)
            for animation, take in present.items()
            if take.version == wanted[animation].version
        )
        return CollectionChange(add_motions(record, proposal.motions), put)

    collections.change(identifier, change)
