"""Segmentations: asking for one, following it, cancelling or deleting it."""

from datetime import UTC, datetime
from functools import partial
from typing import Annotated
from urllib.parse import urlencode

from anyio import to_thread
from fastapi import APIRouter, Header, Query, Request, Response
from fastapi.responses import StreamingResponse

from caesura.core.parameters import Parameters
from caesura.service.api_description.media_types import CANCELLED, EVENTS, SUBMITTED
from caesura.service.api_description.request_bodies import SUBMISSION, WAIT
from caesura.service.auth.authentication import is_still_admitted
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import BackendDependency
from caesura.service.http.json_body import is_json
from caesura.service.http.paging import Cursor, Limit, decode_cursor, encode_cursor
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.http.stream_limit import stream_client
from caesura.service.response_documents import SegmentationPage, StatusDocument
from caesura.service.segmentations.document_response import document_response, preference_applied, submission_response
from caesura.service.segmentations.event_stream import counted_stream, event_id, status_events
from caesura.service.segmentations.segmentation_request import request_from_json, request_from_query
from caesura.service.segmentations.submission import submit_segmentation
from caesura.service.uploads.registration import register_upload
from caesura.service.uploads.remote_file import fetch_upload
from caesura.service.uploads.upload_body import receive_upload
from caesura.service.webhooks.callback_url import check_callback_url, register_callback
from caesura.worker.records.async_records import SegmentationFilter
from caesura.worker.records.record_types import SegmentationRecord, Status
from caesura.worker.retention import deletion

MICROSECOND_ROUNDING = 0.6e-6
"""Seconds by which a stored time may lie before the one that is told, which has whole microseconds."""

router = APIRouter(prefix="/v1/segmentations", tags=["segmentations"])


@router.post("", status_code=202, response_model=StatusDocument, responses=SUBMITTED, openapi_extra=SUBMISSION)
async def create_segmentation(request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Find the motions of an animation.

    JSON or the query names the animation, or the body is the file itself, or a form of files. The same file and
    parameters again are the same segmentation, and no second job.
    """
    if is_json(request.headers):
        order = await request_from_json(request)
    else:
        order = request_from_query(request.query_params)
    if order.callback_url:
        await check_callback_url(backend, order.callback_url)
    if order.animation:
        animation = await backend.animation(order.animation, owner)
        parameters = Parameters.parse(order.parameters)
    else:
        Parameters.parse(order.parameters)  # refused before a long upload
        await to_thread.run_sync(backend.jobs.queues.check_room)
        source = fetch_upload(backend, order.url, order.name) if order.url else receive_upload(request, backend)
        async with source as upload:
            order = order.with_fields(upload.fields)
            if "callback_url" in upload.fields:
                await check_callback_url(backend, order.callback_url)
            parameters = Parameters.parse(order.parameters)
            animation, _ = await to_thread.run_sync(register_upload, backend, owner, upload.parts, order.name)
    record = await to_thread.run_sync(submit_segmentation, backend, animation, parameters, order.name)
    await register_callback(backend, record.id, order.callback_url)
    return await submission_response(backend, request, record)


@router.get("", response_model=SegmentationPage)
async def list_segmentations(
    backend: BackendDependency,
    owner: Owner,
    animation: Annotated[str, Query(max_length=100, description="an animation's id: its segmentations alone")] = "",
    status: Annotated[Status | None, Query(description="those in this state alone")] = None,
    since: Annotated[datetime | None, Query(description="those made at or after this time alone, by RFC 3339")] = None,
    limit: Limit = 20,
    cursor: Cursor = "",
) -> Response:
    """List segmentations, newest first, without their segments."""
    if animation:
        await backend.animation(animation, owner)
    wanted = SegmentationFilter(owner, animation, status, _seconds(since))
    page, last = await backend.records.find_segmentations(wanted, limit, decode_cursor(cursor))
    entries = tuple(StatusDocument.of(record).model_copy(update={"segments": None}) for record in page)
    names = {"animation": animation, "status": status, "since": since and since.isoformat(), "limit": limit}
    query = urlencode({name: value for name, value in names.items() if value})
    more = None if last is None else f"/v1/segmentations?{query}&cursor={encode_cursor(last)}"
    return document_response(SegmentationPage(segmentations=entries, next=more))


def _seconds(since: datetime | None) -> float | None:
    """Seconds since 1970 from which on a time reads so or later; a time without a zone is in UTC."""
    if since is None:
        return None
    return (since if since.tzinfo else since.replace(tzinfo=UTC)).timestamp() - MICROSECOND_ROUNDING


@router.get("/{identifier}", response_model=StatusDocument, openapi_extra=WAIT)
async def get_segmentation(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Tell how far a segmentation is.

    With `Prefer: wait=N` the answer comes as soon as it is over, and at most N seconds from now.
    """
    record = await backend.wait_until_settled(
        await backend.segmentation(identifier, owner), preferred_wait_seconds(request)
    )
    return document_response(
        StatusDocument.of(record, await backend.position(record)), 200, preference_applied(request)
    )


@router.get("/{identifier}/events", response_class=StreamingResponse, responses=EVENTS)
async def follow_segmentation(
    identifier: str,
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    last_event_id: Annotated[str, Header()] = "",
) -> Response:
    """Follow a segmentation live, as server-sent events.

    An event comes at every change, until it is over, or the key that asked is revoked.
    """
    record = await backend.segmentation(identifier, owner)
    if not record.live and event_id(record) == last_event_id:
        return Response(status_code=204)  # tells an EventSource not to come back
    who = stream_client(request)
    backend.stream_limit.check(who)
    stream = status_events(backend, identifier, last_event_id, partial(is_still_admitted, backend, request))
    slot = backend.stream_limit.open_stream(who)
    return StreamingResponse(
        counted_stream(slot, stream), headers={"Cache-Control": "no-store"}, media_type="text/event-stream"
    )


@router.delete("/{identifier}", response_model=StatusDocument, responses=CANCELLED)
async def delete_segmentation(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Cancel or delete a segmentation.

    While it is queued or running it is cancelled (200); once it is over it is deleted with its result (204).
    """
    record = await backend.segmentation(identifier, owner)
    cancelled: SegmentationRecord | None = None
    if record.live:
        cancelled = await to_thread.run_sync(backend.jobs.cancel, identifier)
    if cancelled is not None:
        return document_response(StatusDocument.of(cancelled))
    await to_thread.run_sync(deletion.delete_segmentation, backend.jobs, backend.blobs, identifier)
    return Response(status_code=204)
