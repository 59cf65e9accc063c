"""Collections: many takes in the same motions."""

import time

from anyio import to_thread
from fastapi import APIRouter, Request, Response

from caesura.service.api_description.media_types import COLLECTED
from caesura.service.api_description.request_bodies import WAIT
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.collections.corrections import change_motion, check_name
from caesura.service.collections.documents import CollectionDocument, CollectionPage
from caesura.service.collections.lookup import find_collection, wait_for
from caesura.service.collections.membership import add_animations, find_animations
from caesura.service.collections.requests import CollectionName, MotionChange, NewCollection
from caesura.service.http.paging import Cursor, Limit, decode_cursor, encode_cursor
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.segmentations.document_response import document_response, preference_applied
from caesura.worker.queue.collection_jobs import submit_labelling_if_lost
from caesura.worker.records import content_ids
from caesura.worker.records.async_collections import AsyncCollections
from caesura.worker.records.collection_types import CollectionRecord
from caesura.worker.records.collections import CollectionChange
from caesura.worker.retention import deletion

router = APIRouter(prefix="/v1/collections", tags=["collections"])


@router.post("", status_code=201, response_model=CollectionDocument, responses=COLLECTED)
async def create_collection(given: NewCollection, backend: BackendDependency, owner: Owner) -> Response:
    """Make a collection of animations.

    Those that are given are cut together, once each is analysed; more can be added at any time.
    """
    name = check_name(given.name)
    animations = await to_thread.run_sync(find_animations, backend, owner, given.animations)
    now = time.time()
    asked = None if given.motions == "auto" else given.motions
    record = CollectionRecord(
        id=content_ids.random_token(), owner=owner, name=name, created=now, updated=now, asked=asked
    )
    await to_thread.run_sync(_create, backend, record)
    if animations:
        record = await to_thread.run_sync(add_animations, backend, record.id, animations)
    headers = {"Location": f"/v1/collections/{record.id}"}
    return document_response(CollectionDocument.of(record), 201, headers)


@router.get("", response_model=CollectionPage)
async def list_collections(
    backend: BackendDependency, owner: Owner, limit: Limit = 20, cursor: Cursor = ""
) -> Response:
    """List collections, newest first."""
    page = await AsyncCollections(backend.records).page(owner, limit, decode_cursor(cursor))
    last = encode_cursor(page[-1].created) if len(page) == limit else None
    more = None if last is None else f"/v1/collections?limit={limit}&cursor={last}"
    return document_response(CollectionPage(collections=tuple(map(CollectionDocument.of, page)), next=more))


@router.get("/{identifier}", response_model=CollectionDocument, openapi_extra=WAIT)
async def get_collection(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Describe a collection and its motions.

    With `Prefer: wait=N` the answer comes as soon as all takes are labelled, and at most N seconds from now.
    """
    record = await find_collection(backend, identifier, owner)
    if record.waiting:
        await to_thread.run_sync(submit_labelling_if_lost, backend.jobs, identifier)

        async def ready() -> bool:
            return not (await find_collection(backend, identifier, owner)).waiting

        await wait_for(backend, request, identifier, ready)
        record = await find_collection(backend, identifier, owner)
    return document_response(CollectionDocument.of(record), 200, preference_applied(request))


@router.patch("/{identifier}", response_model=CollectionDocument)
async def rename_collection(
    identifier: str, given: CollectionName, backend: BackendDependency, owner: Owner
) -> Response:
    """Rename a collection."""
    await find_collection(backend, identifier, owner)
    name = check_name(given.name)
    record = await to_thread.run_sync(_rename, backend, identifier, name)
    return document_response(CollectionDocument.of(record))


@router.delete("/{identifier}", status_code=204)
async def delete_collection(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Delete a collection; its animations and their segmentations stay."""
    record = await find_collection(backend, identifier, owner)
    await to_thread.run_sync(deletion.delete_collection, backend.jobs, backend.blobs, record)
    return Response(status_code=204)


@router.patch("/{identifier}/motions/{motion}", response_model=CollectionDocument)
async def change_collection_motion(
    identifier: str, motion: str, given: MotionChange, backend: BackendDependency, owner: Owner
) -> Response:
    """Name a motion, or give it a colour, in all takes at once.

    The program never changes either again.
    """
    await find_collection(backend, identifier, owner)
    record = await to_thread.run_sync(change_motion, backend, identifier, motion, given)
    return document_response(CollectionDocument.of(record))


def _create(backend: Backend, record: CollectionRecord) -> None:
    backend.jobs.records.collections.create(record)


def _rename(backend: Backend, identifier: str, name: str) -> CollectionRecord:
    def change(record: CollectionRecord) -> CollectionChange:
        return CollectionChange(record.model_copy(update={"name": name, "updated": time.time()}))

    record = backend.jobs.records.collections.change(identifier, change)
    if record is None:
        raise RequestProblem("not-found", f"There is no collection {identifier}. It may have been deleted.")
    return record
