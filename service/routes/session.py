"""Signing in and out, for browsers: a key for a cookie."""

from fastapi import APIRouter, Request, Response
from pydantic import BaseModel, Field

from caesura.service.api_keys.credentials import digest_of
from caesura.service.auth import sessions
from caesura.service.auth.authentication import find_key
from caesura.service.auth.middleware import UnknownCaller
from caesura.service.backend import BackendDependency
from caesura.service.problems.problem_response import RequestProblem

router = APIRouter(prefix="/v1/session", tags=["session"])


class SignIn(BaseModel):
    """A key, as `caesura keys add` showed it."""

    key: str = Field(min_length=1, max_length=200)


@router.post("", status_code=204)
async def sign_in(request: Request, backend: BackendDependency, given: SignIn) -> Response:
    """Sign a browser in.

    The answer sets a cookie that stands for the key until its time is up, or the key is revoked.
    """
    record = await find_key(backend, digest_of(given.key.strip()))
    if record is None:
        raise UnknownCaller("unknown-key", "This key opens nothing here: it is wrong, or it was revoked.")
    if record.metrics:
        raise RequestProblem(
            "not-allowed", "This key opens /metrics and nothing else. Sign in with one that sees takes."
        )
    response = Response(status_code=204)
    await sessions.begin_session(backend.records.redis, record.digest, request, response)
    return response


@router.delete("", status_code=204)
async def sign_out(request: Request, backend: BackendDependency) -> Response:
    """Sign a browser out.

    Its cookie stands for nothing any more.
    """
    response = Response(status_code=204)
    await sessions.end_session(backend.records.redis, request, response)
    return response
