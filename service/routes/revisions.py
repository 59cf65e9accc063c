"""Revisions: segments that people edited, stored beside the computed result."""

from collections.abc import Sequence
from contextlib import aclosing

from anyio import to_thread
from fastapi import APIRouter, Request, Response

from caesura.core.revision import Edit, check_edits
from caesura.core.segmentation_document import Loop
from caesura.service.api_description.media_types import REVISED, REVISION
from caesura.service.api_description.request_bodies import REVISION_BODY
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.response_documents import RevisionDocument, RevisionEntry, RevisionList
from caesura.service.results.byte_ranges import cache_headers, is_not_modified
from caesura.service.results.result_response import unfinished_response
from caesura.service.results.revision_request import (
    expected_revision,
    parse_revision_request,
    refuse_stale_revision,
    revised_document,
    revision_number,
)
from caesura.service.segmentations.document_response import document_response, preference_applied
from caesura.worker.queue.auxiliary_jobs import submit_loop_search
from caesura.worker.queue.queues import QueueFull
from caesura.worker.records.record_types import RevisionRecord, SegmentationRecord
from caesura.worker.records.revisions import Revisions, add_revision

router = APIRouter(prefix="/v1/segmentations/{identifier}/revisions", tags=["revisions"])


@router.post("", status_code=201, response_model=RevisionDocument, responses=REVISED, openapi_extra=REVISION_BODY)
async def create_revision(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Keep the segments as a person has set them.

    They are the newest revision; the computed result stays as it is. If-Match names the revision that was edited:
    where another has come since, 412 and nothing is kept. With `Prefer: wait=N` a worker searches the best loops of
    segments that were cut otherwise, for N seconds at most; else such a segment keeps the best that lies within it.
    """
    record = await backend.segmentation(identifier, owner)
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    before = expected_revision(request)
    order = await parse_revision_request(request)
    edits = check_edits(order.segments, record.frames or 0)
    loops = await _searched_loops(backend, request, record, edits)
    kept = await to_thread.run_sync(add_revision, backend.jobs.records, identifier, before, order.note, edits, loops)
    if kept is None:
        raise refuse_stale_revision(await backend.segmentation(identifier, owner))
    headers = {"Location": f"/v1/segmentations/{identifier}/revisions/{kept.number}", "ETag": f'"{kept.number}"'}
    headers |= preference_applied(request)
    return document_response(await _document(backend, record, kept), 201, headers)


@router.get("", response_model=RevisionList)
async def list_revisions(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """List all revisions of a result, the computed one first.

    They come without their segments. The ETag is that of the newest.
    """
    record = await backend.segmentation(identifier, owner)
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    kept = [_computed_revision(record), *await Revisions(backend.records).all(identifier)]
    entries = tuple(RevisionEntry.of(identifier, one) for one in kept)
    return document_response(RevisionList(revisions=entries), 200, cache_headers(f'"{kept[-1].number}"'))


@router.get("/{revision}", response_model=RevisionDocument, responses=REVISION)
async def get_revision(
    identifier: str, revision: str, request: Request, backend: BackendDependency, owner: Owner
) -> Response:
    """Fetch one revision with its segments.

    0 is the result as computed, `latest` the newest revision.
    """
    record = await backend.segmentation(identifier, owner)
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    number = revision_number(record, revision)
    headers = cache_headers(f'"{number}"')
    if is_not_modified(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    kept = await Revisions(backend.records).one(identifier, number) if number else None
    return document_response(
        await _document(backend, record, kept[0] if kept else _computed_revision(record)), 200, headers
    )


async def _searched_loops(
    backend: Backend, request: Request, record: SegmentationRecord, edits: Sequence[Edit]
) -> tuple[Loop | None, ...] | None:
    """The best loop of each segment, searched by a worker where a segment was cut otherwise.

    None where the client does not wait for that, and where they are not there in time: then a segment keeps the best
    of the computed loops that lie within it.
    """
    known = {(segment.start, segment.end): segment.best_loop for segment in record.segments}
    changed = [edit for edit in edits if (edit.start, edit.end) not in known]
    seconds = preferred_wait_seconds(request)
    if not seconds or not changed or record.analysis is None:
        return None
    try:
        token = await to_thread.run_sync(submit_loop_search, backend.jobs, record.id, changed)
    except QueueFull:
        return None
    with backend.limited_wait(seconds):
        async with aclosing(backend.records.follow_changes(record.id)) as changes:
            async for _ in changes:
                found = await Revisions(backend.records).searched_loops(token)
                if found is not None:
                    bounds = [(edit.start, edit.end) for edit in changed]
                    known |= dict(zip(bounds, found, strict=True))
                    return tuple(known[edit.start, edit.end] for edit in edits)
    return None


async def _document(backend: Backend, record: SegmentationRecord, kept: RevisionRecord) -> RevisionDocument:
    segments = (await revised_document(backend, record, kept.number)).segments
    return RevisionDocument.of(record.id, kept, segments=segments)


def _computed_revision(record: SegmentationRecord) -> RevisionRecord:
    return RevisionRecord(number=0, created=record.created)
