"""Proposals of a collection: what would change is shown first, and a person accepts or refuses it."""

from functools import partial

from anyio import to_thread
from fastapi import APIRouter, Request, Response

from caesura.service.api_description.media_types import PROPOSED
from caesura.service.api_description.request_bodies import WAIT
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.collections.documents import ProposalDocument, ProposalEntry, ProposalList
from caesura.service.collections.lookup import find_collection, find_ended
from caesura.service.collections.proposals import decide, propose_recut
from caesura.service.collections.requests import Decision, NewProposal
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.segmentations.document_response import document_response, preference_applied
from caesura.worker.records.async_collections import AsyncCollections
from caesura.worker.records.collection_types import ProposalRecord

router = APIRouter(prefix="/v1/collections/{identifier}/proposals", tags=["collections"])


@router.post("", status_code=202, response_model=ProposalEntry, responses=PROPOSED)
async def create_proposal(identifier: str, given: NewProposal, backend: BackendDependency, owner: Owner) -> Response:
    """Propose to cut all takes together anew.

    Names and corrections of people stay in it; nothing changes before it is accepted.
    """
    await find_collection(backend, identifier, owner)
    asked = None if given.motions == "auto" else given.motions
    made = await to_thread.run_sync(propose_recut, backend, identifier, asked)
    headers = {"Location": f"/v1/collections/{identifier}/proposals/{made.id}"}
    return document_response(ProposalEntry.of(identifier, made), 202, headers)


@router.get("", response_model=ProposalList)
async def list_proposals(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """List the proposals of a collection, newest first, but for the takes."""
    await find_collection(backend, identifier, owner)
    kept = await AsyncCollections(backend.records).proposals(identifier)
    return document_response(ProposalList(proposals=tuple(ProposalEntry.of(identifier, one) for one in kept)))


@router.get("/{proposal}", response_model=ProposalDocument, openapi_extra=WAIT)
async def get_proposal(
    identifier: str, proposal: str, request: Request, backend: BackendDependency, owner: Owner
) -> Response:
    """Show what a proposal would change, take by take.

    With `Prefer: wait=N` the answer comes as soon as it is worked out, and at most N seconds from now.
    """
    await find_collection(backend, identifier, owner)
    kept = await find_ended(backend, request, identifier, partial(_find, backend, identifier, proposal))
    return document_response(ProposalDocument.whole(identifier, kept), 200, preference_applied(request))


@router.patch("/{proposal}", response_model=ProposalEntry)
async def decide_proposal(
    identifier: str, proposal: str, given: Decision, backend: BackendDependency, owner: Owner
) -> Response:
    """Accept or refuse a proposal.

    Accepted, it changes the takes as it shows, but for those that were changed since it was made.
    """
    await find_collection(backend, identifier, owner)
    decided = await to_thread.run_sync(decide, backend, identifier, proposal, given.status == "accepted")
    return document_response(ProposalEntry.of(identifier, decided))


async def _find(backend: Backend, identifier: str, proposal: str) -> ProposalRecord:
    kept = await AsyncCollections(backend.records).proposal(identifier, proposal)
    if kept is None:
        raise RequestProblem("not-found", f"The collection has no proposal {proposal}.")
    return kept
