"""Several segmentations in one request, each with an answer of its own."""

from typing import Any

from anyio import to_thread
from fastapi import APIRouter, Request
from pydantic import BaseModel, Field

from caesura.core.errors import CaesuraError, ParameterError
from caesura.core.parameters import Parameters
from caesura.service.api_description.openapi import Problem
from caesura.service.api_description.request_bodies import BATCH
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.http.json_body import is_json, read_json_body
from caesura.service.problems.problem_response import problem_document
from caesura.service.response_documents import StatusDocument
from caesura.service.segmentations.segmentation_request import (
    SegmentationRequest,
    request_from_batch_item,
    request_from_query,
)
from caesura.service.segmentations.submission import submit_segmentation
from caesura.service.uploads.registration import register_upload
from caesura.service.uploads.spool import Part
from caesura.service.uploads.upload_body import receive_upload
from caesura.service.webhooks.callback_url import check_callback_url, register_callback
from caesura.worker.records.record_types import AnimationRecord

MOST_ITEMS = 100

router = APIRouter(prefix="/v1/batches", tags=["segmentations"])


class BatchAnswer(BaseModel):
    """What one item would have been answered alone: its status, and the segmentation or the problem."""

    status: int
    segmentation: StatusDocument | None = None
    problem: Problem | None = None


class BatchDocument(BaseModel):
    """The answers, in the order of the items."""

    answers: tuple[BatchAnswer, ...] = Field(description="one for each item")


@router.post("", openapi_extra=BATCH)
async def create_batch(request: Request, backend: BackendDependency, owner: Owner) -> BatchDocument:
    """Ask for several segmentations at once.

    JSON lists them, each as it would be alone; a form holds files, each an animation of its own, with parameters for
    all. One that is refused does not stop the others.
    """
    if is_json(request.headers):
        return BatchDocument(answers=tuple([await _named(backend, owner, item) for item in await _items(request)]))
    given = request_from_query(request.query_params)
    Parameters.parse(given.parameters)  # refused before a long upload
    async with receive_upload(request, backend) as upload:
        order = given.with_fields(upload.fields)
        Parameters.parse(order.parameters)
        return BatchDocument(answers=tuple([await _uploaded(backend, owner, order, part) for part in upload.parts]))


async def _items(request: Request) -> list[Any]:
    given = await read_json_body(request, '{"segmentations": [{"animation": "…"}]}')
    items = given.get("segmentations")
    if given.keys() != {"segmentations"} or not isinstance(items, list) or not 0 < len(items) <= MOST_ITEMS:
        detail = f'Send {{"segmentations": […]}} with 1 to {MOST_ITEMS} items, and nothing else.'
        raise ParameterError("invalid-parameter", detail, pointer="/segmentations")
    return items


async def _named(backend: Backend, owner: str, item: Any) -> BatchAnswer:
    """One item of the JSON."""
    try:
        if not isinstance(item, dict) or not item.get("animation") or item.get("url"):
            detail = 'Each item names an animation that was uploaded before: {"animation": "…"}.'
            raise ParameterError("missing-parameter", detail, parameter="animation")
        order = request_from_batch_item(dict(item))
        parameters = Parameters.parse(order.parameters)
        animation = await backend.animation(order.animation, owner)
        return await _submitted(backend, order, animation, parameters)
    except CaesuraError as refused:
        return _refused(refused)


async def _uploaded(backend: Backend, owner: str, order: SegmentationRequest, part: Part) -> BatchAnswer:
    """One file of the form."""
    try:
        animation, _ = await to_thread.run_sync(register_upload, backend, owner, (part,), "")
        return await _submitted(backend, order, animation, Parameters.parse(order.parameters))
    except CaesuraError as refused:
        return _refused(refused)


async def _submitted(
    backend: Backend, order: SegmentationRequest, animation: AnimationRecord, parameters: Parameters
) -> BatchAnswer:
    if order.callback_url:
        await check_callback_url(backend, order.callback_url)
    record = await to_thread.run_sync(submit_segmentation, backend, animation, parameters, order.name)
    await register_callback(backend, record.id, order.callback_url)
    return BatchAnswer(status=202 if record.live else 200, segmentation=StatusDocument.of(record))


def _refused(refused: CaesuraError) -> BatchAnswer:
    document = problem_document(refused.problem())
    return BatchAnswer(status=document["status"], problem=Problem.model_validate(document))
