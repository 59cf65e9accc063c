"""Problem documents, and the table of their statuses and titles.

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
"""Status by code, else by kind. A code in neither is a bug: 500."""

TITLE_OF_CODE = {
    "foreign-host": "Host name not allowed",
    "foreign-origin": "Origin not allowed",
    "gone": "File deleted",
    "internal-error": "Internal server error",
    "invalid-gltf": "Invalid glTF file",
    "json-too-long": "JSON body too long",
    "key-needed": "API key required",
    "malformed-bvh": "Malformed BVH file",
    "malformed-glb": "Malformed GLB file",
    "malformed-json": "Malformed JSON",
    "malformed-multipart": "Malformed multipart form",
    "malformed-npz": "Malformed NPZ file",
    "malformed-shape": "Malformed OBJ or PLY file",
    "malformed-zip": "Malformed zip archive",
    "motions-needed": "Number of motions required",
    "no-animation": "No animation in the file",
    "no-file": "File required",
    "no-if-match": "If-Match header required",
    "no-key-frames": "No key-frames in the result",
    "no-mesh": "No mesh in the file",
    "no-motion": "No motion in the file",
    "not-allowed": "Not allowed with this key",
    "not-finished": "Result not finished",
    "not-ready": "Service at capacity",
    "out-of-memory": "Memory limit reached",
    "out-of-time": "Time limit reached",
    "outside-take": "Time range outside the take",
    "queue-full": "Queue full",
    "stale-revision": "Newer revision exists",
    "storage-full": "Insufficient storage",
    "unknown-key": "Unknown API key",
}
"""Titles of codes that do not read as a title themselves; every other title is its code in words."""

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
        "title": TITLE_OF_CODE.get(code) or code.replace("-", " ").capitalize(),
        "status": status,
        **problem,
    }
    retry = {"Retry-After": str(RETRY_SECONDS[status])} if status in RETRY_SECONDS else {}
    all_headers = {
        "Cache-Control": "no-store",
        **retry,
        **(headers or {}),
    }  # a 404 may be kept for others, unless it says so
    return JSONResponse(document, status, all_headers, MEDIA_TYPE)


def refusal_response(refused: Refusal) -> Response:
    """A refusal, with the headers that belong to it."""
    return problem_response(refused.problem(), refused.headers)
