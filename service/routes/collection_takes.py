"""The takes of a collection: added, removed, and corrected by people."""

import re

from anyio import to_thread
from fastapi import APIRouter, Request, Response

from caesura.service.api_description.media_types import ADDED, TAKE
from caesura.service.api_description.request_bodies import TAKE_TAG
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.collections.corrections import correct_segments
from caesura.service.collections.documents import CollectionDocument, CollectionTake, TakePage
from caesura.service.collections.lookup import find_collection, find_take
from caesura.service.collections.membership import add_animations, find_animations
from caesura.service.collections.proposals import propose_correction
from caesura.service.collections.requests import AddedTakes, Correction
from caesura.service.http.paging import Cursor, Limit, decode_cursor, encode_cursor
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.segmentations.document_response import document_response
from caesura.worker.records.async_collections import AsyncCollections
from caesura.worker.records.collection_types import TakeRecord
from caesura.worker.retention import deletion

router = APIRouter(prefix="/v1/collections/{identifier}/takes", tags=["collections"])


@router.post("", status_code=202, response_model=CollectionDocument, responses=ADDED)
async def add_takes(identifier: str, given: AddedTakes, backend: BackendDependency, owner: Owner) -> Response:
    """Add animations to a collection.

    Each is labelled in the motions that the collection has, once it is analysed; a motion that it has not is added.
    Those that are in it already stay as they are.
    """
    await find_collection(backend, identifier, owner)
    animations = await to_thread.run_sync(find_animations, backend, owner, given.animations)
    record = await to_thread.run_sync(add_animations, backend, identifier, animations)
    return document_response(CollectionDocument.of(record), 202, {"Location": f"/v1/collections/{identifier}"})


@router.get("", response_model=TakePage)
async def list_takes(
    identifier: str, backend: BackendDependency, owner: Owner, limit: Limit = 20, cursor: Cursor = ""
) -> Response:
    """List the takes of a collection, the last added first.

    They come with their segments in its motions.
    """
    await find_collection(backend, identifier, owner)
    page = await AsyncCollections(backend.records).takes(identifier, limit, decode_cursor(cursor))
    here = f"/v1/collections/{identifier}/takes?limit={limit}"
    more = f"{here}&cursor={encode_cursor(page[-1].added)}" if len(page) == limit else None
    return document_response(TakePage(takes=tuple(CollectionTake.of(identifier, take) for take in page), next=more))


@router.get("/{animation}", response_model=CollectionTake, responses=TAKE)
async def get_take(identifier: str, animation: str, backend: BackendDependency, owner: Owner) -> Response:
    """Describe one take of a collection."""
    await find_collection(backend, identifier, owner)
    return _response(identifier, await find_take(backend, identifier, animation))


@router.patch("/{animation}", response_model=CollectionTake, responses=TAKE, openapi_extra=TAKE_TAG)
async def correct_take(
    identifier: str, animation: str, given: Correction, request: Request, backend: BackendDependency, owner: Owner
) -> Response:
    """Set the segments of a take.

    What a person set stays. What it says of the other takes becomes a proposal, which `proposal` names.
    """
    await find_collection(backend, identifier, owner)
    expected = _expected_version(request)
    take, fresh = await to_thread.run_sync(correct_segments, backend, identifier, animation, given, expected)
    made = await to_thread.run_sync(propose_correction, backend, identifier, animation) if fresh else None
    return _response(identifier, take, made.id if made else None)


@router.delete("/{animation}", status_code=204)
async def remove_take(identifier: str, animation: str, backend: BackendDependency, owner: Owner) -> Response:
    """Take an animation out of a collection; the animation itself stays."""
    await find_collection(backend, identifier, owner)
    await find_take(backend, identifier, animation)
    await to_thread.run_sync(_remove, backend, identifier, animation)
    return Response(status_code=204)


def _remove(backend: Backend, identifier: str, animation: str) -> None:
    deletion.remove_from_collection(backend.jobs, backend.blobs, identifier, animation)


def _response(identifier: str, take: TakeRecord, proposal: str | None = None) -> Response:
    return document_response(CollectionTake.of(identifier, take, proposal), 200, {"ETag": f'"{take.version}"'})


def _expected_version(request: Request) -> int | None:
    """The version that the client has corrected, where If-Match says it."""
    header = request.headers.get("if-match", "").strip()
    if header in {"", "*"}:
        return None
    tag = re.fullmatch(r'"([0-9]{1,9})"', header)
    if tag is None:
        raise RequestProblem("stale-take", 'If-Match is no tag of a take. It is such as "0": a number in quotes.')
    return int(tag[1])
