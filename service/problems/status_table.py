"""Every problem the service answers with, and the one table that gives it a status.

Below this layer nobody knows HTTP: `core` raises, the worker stores, and here each code or kind becomes a status
and an RFC 9457 problem document.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from fastapi import Response
from fastapi.responses import JSONResponse

from caesura.core.errors import CaesuraError

MEDIA_TYPE = "application/problem+json"

STATUS_OF_CODE: dict[str, int] = {
    # kinds of core.errors: what is wrong with the file or the parameters
    "unsupported-media": 415,
    "broken-container": 400,
    "invalid-model": 422,
    "limit": 422,
    "input": 422,
    "parameter": 422,
    # codes, where one of a kind has a status of its own
    "upload-too-large": 413,
    "json-too-long": 400,
    "key-needed": 401,
    "unknown-key": 401,
    "not-allowed": 403,
    "foreign-host": 403,
    "foreign-origin": 403,
    "not-found": 404,
    "method-not-allowed": 405,
    "not-acceptable": 406,
    "not-finished": 409,
    "cancelled": 409,
    "too-many-revisions": 409,
    "stale-revision": 412,
    "no-if-match": 428,
    "gone": 410,
    "animation-deleted": 410,
    "range-not-satisfiable": 416,
    "too-many-requests": 429,
    "too-many-streams": 429,
    "queue-unavailable": 503,
    "storage-unavailable": 503,
    "not-ready": 503,
    "queue-full": 503,
    "storage-full": 507,
    "out-of-memory": 422,
    "out-of-time": 422,
    "internal-error": 500,
    # the other kinds: what the request did wrong, and what a worker could not help
    "request": 400,
    "worker": 503,
}
"""Status by code, else by kind. What is in neither is a fault of ours: 500."""

RETRY_SECONDS = {409: 1, 503: 5}


class Refusal(CaesuraError):
    """The request cannot be answered as it stands: nothing there, not ready yet, or not understood."""

    kind = "request"
    headers: Mapping[str, str] = MappingProxyType({})


def status_of(problem: Mapping[str, Any]) -> int:
    """The HTTP status of a problem, raised here or stored by a worker."""
    return STATUS_OF_CODE.get(problem["code"]) or STATUS_OF_CODE.get(problem.get("kind", ""), 500)


def problem_response(problem: Mapping[str, Any], headers: Mapping[str, str] | None = None) -> Response:
    """The problem document: type, title, status, detail, code, and where (pointer, parameter, limit, …)."""
    status = status_of(problem)
    code = str(problem["code"])
    document = {
        "type": f"urn:caesura:problem:{code}",
        "title": code.replace("-", " ").capitalize(),
        "status": status,
        **problem,
    }
    retry = {"Retry-After": str(RETRY_SECONDS[status])} if status in RETRY_SECONDS else {}
    told = {"Cache-Control": "no-store", **retry, **(headers or {})}  # a 404 may be kept for others, unless it says so
    return JSONResponse(document, status, told, MEDIA_TYPE)


def refusal_response(refused: Refusal) -> Response:
    """A refusal, with the headers that belong to it."""
    return problem_response(refused.problem(), refused.headers)
