"""Search by example in a collection."""

import time
from functools import partial

from anyio import to_thread
from fastapi import APIRouter, Request, Response

from caesura.core.parameters import Parameters
from caesura.service.api_description.media_types import SEARCHED
from caesura.service.api_description.request_bodies import WAIT
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.collections.documents import SearchDocument
from caesura.service.collections.lookup import find_collection, find_ended
from caesura.service.collections.requests import NewSearch
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.segmentations.document_response import document_response, preference_applied
from caesura.service.segmentations.submission import submit_segmentation
from caesura.worker.queue.collection_jobs import submit_search
from caesura.worker.records import content_ids
from caesura.worker.records.async_collections import AsyncCollections
from caesura.worker.records.collection_types import SearchRecord
from caesura.worker.records.record_types import AnimationRecord

router = APIRouter(prefix="/v1/collections/{identifier}/searches", tags=["collections"])


@router.post("", status_code=202, response_model=SearchDocument, responses=SEARCHED)
async def create_search(identifier: str, given: NewSearch, backend: BackendDependency, owner: Owner) -> Response:
    """Search all takes of a collection for an example.

    It is a range of an animation; what is found may be bent in time. The animation need not be in it: upload an
    example first, as any other.
    """
    await find_collection(backend, identifier, owner)
    animation = await backend.animation(given.animation, owner)
    made = await to_thread.run_sync(_submit, backend, identifier, given, animation)
    headers = {"Location": f"/v1/collections/{identifier}/searches/{made.id}"}
    return document_response(SearchDocument.of(identifier, made), 202, headers)


@router.get("/{search}", response_model=SearchDocument, openapi_extra=WAIT)
async def get_search(
    identifier: str, search: str, request: Request, backend: BackendDependency, owner: Owner
) -> Response:
    """Fetch what a search has found.

    With `Prefer: wait=N` the answer comes as soon as it is over, and at most N seconds from now.
    """
    await find_collection(backend, identifier, owner)
    kept = await find_ended(backend, request, identifier, partial(_find, backend, identifier, search))
    return document_response(SearchDocument.of(identifier, kept), 200, preference_applied(request))


def _submit(backend: Backend, identifier: str, given: NewSearch, animation: AnimationRecord) -> SearchRecord:
    segmentation = submit_segmentation(backend, animation, Parameters.parse({}), animation.name)
    wanted = SearchRecord(
        id=content_ids.random_token(),
        created=time.time(),
        animation=animation.id,
        segmentation=segmentation.id,
        start=given.start,
        end=given.end or 0,
        limit=given.limit,
    )
    return submit_search(backend.jobs, identifier, wanted)


async def _find(backend: Backend, identifier: str, search: str) -> SearchRecord:
    kept = await AsyncCollections(backend.records).search(identifier, search)
    if kept is None:
        raise RequestProblem("not-found", f"There is no search {search}. They are kept for a day.")
    return kept
