"""The response with a status: 200 when done, 202 while it can change, its problem when it failed."""

from collections.abc import Mapping

from fastapi import Request, Response
from pydantic import BaseModel

from caesura.service.backend import Backend
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.problems.problem_response import problem_response
from caesura.service.response_documents import StatusDocument
from caesura.worker.records.record_types import SegmentationRecord

ASK_AGAIN = {"Retry-After": "1"}


def document_response(document: BaseModel, status: int = 200, headers: Mapping[str, str] | None = None) -> Response:
    """A document as JSON."""
    text = document.model_dump_json()
    return Response(text, status, {"Cache-Control": "no-store", **(headers or {})}, "application/json")


def preference_applied(request: Request) -> dict[str, str]:
    """The header that tells how long was waited at most, where waiting was asked for."""
    seconds = preferred_wait_seconds(request)
    return {} if seconds is None else {"Preference-Applied": f"wait={seconds}"}


async def submission_response(backend: Backend, request: Request, record: SegmentationRecord) -> Response:
    """The answer to a submission, after the wait that the client prefers.

    A segmentation that failed answers with its own 4xx or 5xx, so that `curl --fail` and scripts notice.
    """
    record = await backend.wait_until_settled(record, preferred_wait_seconds(request))
    headers = {"Location": f"/v1/segmentations/{record.id}", **preference_applied(request)}
    if record.live:
        return document_response(StatusDocument.of(record, await backend.position(record)), 202, headers | ASK_AGAIN)
    if record.status == "done":
        return document_response(StatusDocument.of(record), 200, headers)
    return problem_response(problem_of(record), headers)


def problem_of(record: SegmentationRecord) -> Mapping[str, object]:
    """Why a segmentation that ended has no result."""
    if record.problem is not None:
        return record.problem
    detail = "This segmentation was cancelled. Post it again to start anew."
    return {"kind": "request", "code": "cancelled", "detail": detail}
