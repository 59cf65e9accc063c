"""Segmentations: asking for one, following it, cancelling or deleting it."""

from functools import partial
from typing import Annotated

from anyio import to_thread
from fastapi import APIRouter, Header, Query, Request, Response
from fastapi.responses import StreamingResponse

from caesura.core.parameters import Parameters
from caesura.service.api_description.descriptions import EVENTS, SUBMISSION, SUBMITTED
from caesura.service.auth.authentication import is_still_admitted
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import BackendDependency
from caesura.service.documents import SegmentationPage, StatusDocument
from caesura.service.http.json_body import is_json
from caesura.service.http.paging import Cursor, Limit, decode_cursor, encode_cursor
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.http.stream_limit import stream_client
from caesura.service.segmentations.event_stream import counted_stream, event_id, status_events
from caesura.service.segmentations.segmentation_request import request_from_json, request_from_query
from caesura.service.segmentations.status_response import preference_applied, status_response, submission_response
from caesura.service.segmentations.submission import submit_segmentation
from caesura.service.uploads.registration import register_upload
from caesura.service.uploads.upload_body import receive_upload
from caesura.worker.records.schema import SegmentationRecord
from caesura.worker.retention.deletion import delete_segmentation

router = APIRouter(prefix="/v1/segmentations", tags=["segmentations"])


@router.post("", status_code=202, response_model=StatusDocument, responses=SUBMITTED, openapi_extra=SUBMISSION)
async def create(request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Find the motions: of an animation named in JSON or in the query, or of the file that is the body itself.

    The same file and parameters again are the same segmentation, and no second job.
    """
    if is_json(request.headers):
        order = await request_from_json(request)
    else:
        order = request_from_query(request.query_params)
    if order.animation:
        animation = await backend.animation(order.animation, owner)
        parameters = Parameters.parse(order.parameters)
    else:
        Parameters.parse(order.parameters)  # refused before a long upload
        await to_thread.run_sync(backend.jobs.queues.check_room)
        async with receive_upload(request, backend) as upload:
            order = order.with_fields(upload.fields)
            parameters = Parameters.parse(order.parameters)
            animation, _ = await to_thread.run_sync(register_upload, backend, owner, upload.parts, order.name)
    record = await to_thread.run_sync(submit_segmentation, backend, animation, parameters, order.name)
    return await submission_response(backend, request, record)


@router.get("", response_model=SegmentationPage)
async def of_animation(
    backend: BackendDependency,
    owner: Owner,
    animation: Annotated[str, Query(description="the animation's id")],
    limit: Limit = 20,
    cursor: Cursor = "",
) -> Response:
    """The segmentations of one animation, newest first, without their segments."""
    await backend.animation(animation, owner)
    known = backend.records.segmentations(animation, limit, decode_cursor(cursor))
    page = [record.with_(segments=()) async for record in known]
    entries = tuple(StatusDocument.of(record).model_copy(update={"segments": None}) for record in page)
    address = f"/v1/segmentations?animation={animation}&limit={limit}&cursor="
    more = address + encode_cursor(page[-1].created) if len(page) == limit else None
    return status_response(SegmentationPage(segmentations=entries, next=more))


@router.get("/{identifier}", response_model=StatusDocument)
async def status(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """How far it is; with `Prefer: wait=N`, as soon as it is over, at most N seconds from now."""
    record = await backend.wait_until_settled(
        await backend.segmentation(identifier, owner), preferred_wait_seconds(request)
    )
    return status_response(StatusDocument.of(record, await backend.position(record)), 200, preference_applied(request))


@router.get("/{identifier}/events", response_class=StreamingResponse, responses=EVENTS)
async def events(
    identifier: str,
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    last_event_id: Annotated[str, Header()] = "",
) -> Response:
    """The same, live: an event at every change, until it is over, or the key that asked is revoked."""
    record = await backend.segmentation(identifier, owner)
    if not record.live and event_id(record) == last_event_id:
        return Response(status_code=204)  # tells an EventSource not to come back
    who = stream_client(request)
    backend.seats.check(who)
    stream = status_events(backend, identifier, last_event_id, partial(is_still_admitted, backend, request))
    seat = backend.seats.taken(who)
    return StreamingResponse(
        counted_stream(seat, stream), headers={"Cache-Control": "no-store"}, media_type="text/event-stream"
    )


@router.delete("/{identifier}", response_model=StatusDocument, responses={204: {"description": "Deleted."}})
async def cancel_or_delete(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Cancel it while it is queued or running; delete it, with its result, once it is over."""
    record = await backend.segmentation(identifier, owner)
    cancelled: SegmentationRecord | None = None
    if record.live:
        cancelled = await to_thread.run_sync(backend.jobs.cancel, identifier)
    if cancelled is not None:
        return status_response(StatusDocument.of(cancelled))
    await to_thread.run_sync(delete_segmentation, backend.jobs, backend.blobs, identifier)
    return Response(status_code=204)
