"""One table gives every problem its status, and a fault of ours tells nothing but that it is one."""

import asyncio

import httpx
import pytest
import redis
from fastapi import FastAPI

from caesura.core import errors as core_errors
from caesura.service.problems import exception_handlers
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.problems.status_table import STATUS_OF_CODE, status_of
from caesura.worker.store.blobs import BlobMissing


def answered(failure):
    """What a client sees where a route raises `failure`."""
    app = FastAPI()
    exception_handlers.install_handlers(app)

    @app.get("/")
    async def route():
        raise failure

    async def ask():
        transport = httpx.ASGITransport(app, raise_app_exceptions=False)
        async with httpx.AsyncClient(transport=transport, base_url="http://x") as client:
            return await client.get("/")

    return asyncio.run(ask())


def test_every_kind_of_input_error_has_a_status_of_its_own():
    """No refusal of a file or a parameter is ever a 500."""
    for kind, error in core_errors.ERROR_KINDS.items():
        if kind != "error":
            assert 400 <= status_of(error("some-code", "Some sentence.").problem()) < 500


def test_a_code_wins_over_its_kind():
    """An upload over the limit is 413, other limits are 422."""
    assert status_of({"kind": "limit", "code": "upload-too-large"}) == 413
    assert status_of({"kind": "limit", "code": "limit-exceeded"}) == 422


def test_no_problem_is_kept_by_a_cache():
    """What is not there today may be there tomorrow, and what one may not see another may."""
    for failure in (RequestProblem("not-found", "There is none."), redis.ConnectionError("away")):
        assert answered(failure).headers["Cache-Control"] == "no-store"


def test_what_is_in_no_table_is_ours():
    """500, so that nobody is blamed for what we do not know."""
    assert status_of({"kind": "unheard-of", "code": "unheard-of"}) == 500
    client = {400, 401, 403, 404, 405, 406, 409, 410, 412, 413, 415, 416, 422, 423, 428, 429}
    assert set(STATUS_OF_CODE.values()) <= client | {500, 503, 507}


@pytest.mark.parametrize(
    ("failure", "status", "code"),
    [
        (core_errors.InvalidModel("no-mesh", "There is no mesh.", pointer="/meshes"), 422, "no-mesh"),
        (BlobMissing("uploads/x"), 410, "gone"),
        (OSError(28, "No space left on device"), 507, "storage-full"),
        (redis.ConnectionError("refused"), 503, "queue-unavailable"),
        (OSError(5, "/secret/path"), 500, "internal-error"),
        (RuntimeError("a secret"), 500, "internal-error"),
    ],
)
def test_each_failure_is_answered_as_a_problem(failure, status, code):
    """With its place where it has one, and without a word of ours where it is a bug."""
    answer = answered(failure)
    assert (answer.status_code, answer.json()["code"]) == (status, code)
    assert "secret" not in answer.text
    assert answer.headers["Content-Type"] == "application/problem+json"
    assert ("Retry-After" in answer.headers) == (status == 503)
