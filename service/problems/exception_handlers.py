"""Every way a request can fail, answered as a problem document. Routes raise; none of them catches."""

import logging

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from obstore.exceptions import BaseError as StoreError
from redis import exceptions as redis
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

from caesura.core.errors import CaesuraError
from caesura.service.problems.allowed_methods import allowed_methods
from caesura.service.problems.problem_response import RequestProblem, problem_response, request_problem_response
from caesura.worker.records.connection import refuses_writes
from caesura.worker.store.blobs import BlobMissing
from caesura.worker.store.disk_space import FULL, storage_full_error

log = logging.getLogger(__name__)


def install_handlers(app: FastAPI) -> None:
    """Every way a request can fail, answered as a problem document."""
    app.exception_handler(CaesuraError)(_handle_caesura_error)
    app.exception_handler(RequestValidationError)(_handle_invalid_request)
    app.exception_handler(HTTPException)(_handle_routing_error)
    app.exception_handler(ClientDisconnect)(_handle_disconnect)
    for unreachable in (redis.ConnectionError, redis.TimeoutError, redis.BusyLoadingError):
        app.exception_handler(unreachable)(_handle_redis_error)
    app.exception_handler(StoreError)(_store_unavailable)
    for full in (redis.OutOfMemoryError, redis.ReadOnlyError):
        app.exception_handler(full)(_handle_full_disk)
    app.exception_handler(redis.ResponseError)(_refused_write)
    app.exception_handler(BlobMissing)(_handle_missing_blob)
    app.exception_handler(OSError)(_handle_storage_error)
    app.exception_handler(Exception)(_handle_bug)


async def _handle_caesura_error(_: Request, error: CaesuraError) -> Response:
    return request_problem_response(error) if isinstance(error, RequestProblem) else problem_response(error.problem())


async def _handle_invalid_request(_: Request, error: RequestValidationError) -> Response:
    """A query, path or body that does not fit the documented form: the first fault, and where it is."""
    first = error.errors()[0]
    place, *path = (str(step) for step in first["loc"])
    name = path[-1] if path else place
    where = {"pointer": "/" + "/".join(path)} if place == "body" else {"parameter": name}
    return problem_response(
        {"kind": "parameter", "code": "invalid-parameter", "detail": f"{name}: {first['msg']}.", **where}
    )


async def _handle_routing_error(request: Request, error: HTTPException) -> Response:
    path = request.url.path
    if error.status_code == 405:
        allow = ", ".join(allowed_methods(request.app, path))
        if request.method == "OPTIONS":
            return Response(status_code=204, headers={"Allow": allow})
        detail = f"{request.method} is not possible on {path}. Allowed: {allow}."
        problem = {"kind": "request", "code": "method-not-allowed", "detail": detail}
        return problem_response(problem, {"Allow": allow})
    if error.status_code == 404:
        detail = f"No resource exists at {path}. /openapi.json lists all paths."
        return problem_response({"kind": "request", "code": "not-found", "detail": detail})
    return problem_response({"kind": "request", "code": "bad-request", "detail": f"{error.detail}."})


async def _handle_disconnect(_: Request, __: Exception) -> Response:
    """The client hung up: nobody reads this."""
    return Response(status_code=400)


async def _handle_missing_blob(_: Request, __: Exception) -> Response:
    detail = "This file is no longer stored. Upload it again."
    return problem_response({"kind": "request", "code": "gone", "detail": detail})


async def _handle_storage_error(_: Request, error: OSError) -> Response:
    """No room left is said as such; any other trouble with a file is a fault of ours."""
    if error.errno not in FULL:
        raise error
    log.error("The disk is full: %s", error)
    return problem_response(storage_full_error().problem())


async def _refused_write(_: Request, error: redis.ResponseError) -> Response:
    """Redis's disk is full; any other refusal of a command is a fault of ours."""
    if not refuses_writes(error):
        raise error
    log.error("Redis takes no writes: its disk is full")
    return problem_response(storage_full_error().problem())


async def _handle_redis_error(_: Request, error: Exception) -> Response:
    return unavailable(error)


def unavailable(error: Exception) -> Response:
    """Redis does not answer."""
    log.error("Redis does not answer: %s", error)
    detail = "The queue does not answer. No data is lost; try again in a few seconds."
    return problem_response({"kind": "infrastructure", "code": "queue-unavailable", "detail": detail})


async def _store_unavailable(_: Request, error: Exception) -> Response:
    """The object store does not answer; its library has tried for some seconds."""
    log.error("The object store does not answer: %s", str(error).partition("\n")[0])
    detail = "The file store does not answer. The request is valid; try again in a few seconds."
    return problem_response({"kind": "infrastructure", "code": "storage-unavailable", "detail": detail})


async def _handle_full_disk(_: Request, error: Exception) -> Response:
    log.error("Redis refuses new data: %s", error)
    detail = "The service has no memory left for new data. Nothing is stored; try again later."
    return problem_response({"kind": "infrastructure", "code": "not-ready", "detail": detail})


async def _handle_bug(_: Request, __: Exception) -> Response:
    """A fault of ours: logged with its traceback by the server, without details here."""
    detail = "The service has an internal error, which is logged. Try again, and tell the operator if it persists."
    return problem_response({"kind": "internal", "code": "internal-error", "detail": detail})
