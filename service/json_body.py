"""A JSON body, read no further than it may be long: what it says is checked by who asked for it."""

import json
from typing import Any

from fastapi import Request

from service.errors import Refusal


async def json_object(request: Request, longest: int, advice: str, example: str) -> dict[str, Any]:
    """The object that the body is.

    Raises `Refusal` for what is no JSON object, and, with `advice`, for one of more than `longest` bytes.
    """
    text = bytearray()
    async for chunk in request.stream():
        text += chunk
        if len(text) > longest:
            detail = f"The JSON is longer than {longest} bytes. {advice}"
            raise Refusal("json-too-long", detail, limit=longest, actual=len(text))
    try:
        given = json.loads(bytes(text))
        json.dumps(given, ensure_ascii=False).encode()  # half a surrogate pair is no text: no key and no answer
    except (ValueError, RecursionError):
        raise Refusal("malformed-json", "The body is no JSON.") from None
    if not isinstance(given, dict):
        raise Refusal("malformed-json", f"The JSON must be an object, such as {example}.")
    return given
