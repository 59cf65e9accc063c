"""Problem documents (RFC 9457): what a request is answered with that cannot be answered as it stands."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from starlette.responses import JSONResponse, Response

from caesura.core.errors import CaesuraError
from caesura.service.problems.status_table import TITLE_OF_CODE, status_of

MEDIA_TYPE = "application/problem+json"
RETRY_SECONDS = {409: 1, 503: 5}


class RequestProblem(CaesuraError):
    """The request cannot be answered as it stands: nothing there, not ready yet, or not understood."""

    kind = "request"
    headers: Mapping[str, str] = MappingProxyType({})


def problem_document(problem: Mapping[str, Any]) -> dict[str, Any]:
    """The problem document: type, title, status, detail, code, and where (pointer, parameter, limit, …)."""
    code = str(problem["code"])
    return {
        "type": f"urn:caesura:problem:{code}",
        "title": TITLE_OF_CODE.get(code) or code.replace("-", " ").capitalize(),
        "status": status_of(problem),
        **problem,
    }


def problem_response(problem: Mapping[str, Any], headers: Mapping[str, str] | None = None) -> Response:
    """The problem document as an answer."""
    document = problem_document(problem)
    status = document["status"]
    retry = {"Retry-After": str(RETRY_SECONDS[status])} if status in RETRY_SECONDS else {}
    all_headers = {
        "Cache-Control": "no-store",
        **retry,
        **(headers or {}),
    }  # a 404 may be kept for others, unless it says so
    return JSONResponse(document, status, all_headers, MEDIA_TYPE)


def request_problem_response(refused: RequestProblem) -> Response:
    """A refusal, with the headers that belong to it."""
    return problem_response(refused.problem(), refused.headers)
