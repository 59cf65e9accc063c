"""Every problem the service answers with, and the one table that gives it a status.

Below this layer nobody knows HTTP: `core` raises, the worker stores, and here each code or kind becomes a status
and an RFC 9457 problem document. Routes raise; none of them catches.
"""

import errno
import logging
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from obstore.exceptions import BaseError as StoreError
from redis import exceptions as redis
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

from core.errors import CaesuraError
from worker.blobs import BlobMissing

log = logging.getLogger(__name__)

MEDIA_TYPE = "application/problem+json"

STATUS: dict[str, int] = {
    # kinds of core.errors: what is wrong with the file or the parameters
    "unsupported-media": 415,
    "broken-container": 400,
    "invalid-model": 422,
    "limit": 422,
    "input": 422,
    "parameter": 422,
    # codes, where one of a kind has a status of its own
    "upload-too-large": 413,
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
    return STATUS.get(problem["code"]) or STATUS.get(problem.get("kind", ""), 500)


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


def install(app: FastAPI) -> None:
    """Every way a request can fail, answered as a problem document."""
    app.exception_handler(CaesuraError)(_known)
    app.exception_handler(RequestValidationError)(_invalid)
    app.exception_handler(HTTPException)(_routing)
    app.exception_handler(ClientDisconnect)(_gone_away)
    for unreachable in (redis.ConnectionError, redis.TimeoutError, redis.BusyLoadingError):
        app.exception_handler(unreachable)(_unavailable)
    app.exception_handler(StoreError)(_store_unavailable)
    for full in (redis.OutOfMemoryError, redis.ReadOnlyError):
        app.exception_handler(full)(_full)
    app.exception_handler(BlobMissing)(_no_longer_kept)
    app.exception_handler(OSError)(_storage)
    app.exception_handler(Exception)(_bug)


def refusal_response(refused: Refusal) -> Response:
    """A refusal, with the headers that belong to it."""
    return problem_response(refused.problem(), refused.headers)


async def _known(_: Request, error: CaesuraError) -> Response:
    return refusal_response(error) if isinstance(error, Refusal) else problem_response(error.problem())


async def _invalid(_: Request, error: RequestValidationError) -> Response:
    """A query, path or body that does not fit the documented form: the first fault, and where it is."""
    first = error.errors()[0]
    place, *path = (str(step) for step in first["loc"])
    name = path[-1] if path else place
    where = {"pointer": "/" + "/".join(path)} if place == "body" else {"parameter": name}
    return problem_response(
        {"kind": "parameter", "code": "invalid-parameter", "detail": f"{name}: {first['msg']}.", **where}
    )


async def _routing(request: Request, error: HTTPException) -> Response:
    path = request.url.path
    if error.status_code == 405:
        allowed = (error.headers or {}).get("Allow", "")
        detail = f"{request.method} is not possible on {path}. Allowed: {allowed}."
        return problem_response({"kind": "request", "code": "method-not-allowed", "detail": detail}, error.headers)
    if error.status_code == 404:
        detail = f"There is nothing at {path}. /openapi.json lists what there is."
        return problem_response({"kind": "request", "code": "not-found", "detail": detail})
    return problem_response({"kind": "request", "code": "bad-request", "detail": f"{error.detail}."})


async def _gone_away(_: Request, __: Exception) -> Response:
    """The client hung up: nobody reads this."""
    return Response(status_code=400)


async def _no_longer_kept(_: Request, __: Exception) -> Response:
    detail = "This file is no longer kept here: its time has run out. Upload it again."
    return problem_response({"kind": "request", "code": "gone", "detail": detail})


async def _storage(_: Request, error: OSError) -> Response:
    """No room left is said as such; any other trouble with a file is a fault of ours."""
    if error.errno not in {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}:
        raise error
    log.error("No room left: %s", error)
    detail = "The service has no room left for this. Nothing was kept; tell its keeper, or try again later."
    return problem_response({"kind": "request", "code": "storage-full", "detail": detail})


async def _unavailable(_: Request, error: Exception) -> Response:
    return unavailable(error)


def unavailable(error: Exception) -> Response:
    """Redis does not answer."""
    log.error("Redis does not answer: %s", error)
    detail = "The queue cannot be reached just now. Nothing was lost; try again shortly."
    return problem_response({"kind": "infrastructure", "code": "queue-unavailable", "detail": detail})


async def _store_unavailable(_: Request, error: Exception) -> Response:
    """The object store does not answer; its library has tried for some seconds."""
    log.error("The object store does not answer: %s", str(error).partition("\n")[0])
    detail = "The store of files cannot be reached just now. Nothing is wrong with the request; try again shortly."
    return problem_response({"kind": "infrastructure", "code": "storage-unavailable", "detail": detail})


async def _full(_: Request, error: Exception) -> Response:
    log.error("Redis takes no more: %s", error)
    detail = "The service has no room for this just now. Nothing was kept; try again later."
    return problem_response({"kind": "infrastructure", "code": "not-ready", "detail": detail})


async def _bug(_: Request, __: Exception) -> Response:
    """A fault of ours: logged with its traceback by the server, without details here."""
    detail = "Something went wrong on our side. It has been logged; try again, and tell the keeper if it stays."
    return problem_response({"kind": "internal", "code": "internal-error", "detail": detail})
