"""A JSON body: an object, whose fields are checked by who asked for it.

`caesura.service.uploads.body_limit` bounds its length.
"""

import json
from typing import Any

from fastapi import Request
from starlette.datastructures import Headers

from caesura.service.problems.problem_response import RequestProblem


def is_json(headers: Headers) -> bool:
    """Whether the body is announced as JSON."""
    return headers.get("content-type", "").partition(";")[0].strip().lower() == "application/json"


async def read_json_body(request: Request, example: str) -> dict[str, Any]:
    """The object that the body is; raises `RequestProblem` for what is no JSON object."""
    try:
        given = json.loads(await request.body())
        json.dumps(given, ensure_ascii=False).encode()  # half a surrogate pair is no text: no key and no answer
    except (ValueError, RecursionError):
        raise RequestProblem("malformed-json", "The body is no JSON.") from None
    if not isinstance(given, dict):
        raise RequestProblem("malformed-json", f"The JSON must be an object, such as {example}.")
    return given
