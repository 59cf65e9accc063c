"""Long lists by pages: newest first, the next page's address in every answer."""

import base64
import binascii
import math
from typing import Annotated

from fastapi import Query

from caesura.core.errors import ParameterError

Limit = Annotated[int, Query(ge=1, le=100, description="how many to list")]
Cursor = Annotated[str, Query(max_length=64, description="where to go on: from `next` of the page before")]


def encode_cursor(created: float) -> str:
    """Where the page after an entry begins."""
    return base64.urlsafe_b64encode(repr(created).encode()).decode().rstrip("=")


def decode_cursor(cursor: str) -> float | None:
    """The time of creation that the page's entries are before; None for the first page.

    Raises `ParameterError` for a cursor that no page gave.
    """
    if not cursor:
        return None
    try:
        created = float(base64.urlsafe_b64decode(cursor + "=" * (-len(cursor) % 4)))
    except (ValueError, binascii.Error):
        created = math.nan
    if not math.isfinite(created):
        detail = f"cursor = {cursor!r} is none of ours. Take it from `next` of a page, or leave it out."
        raise ParameterError("invalid-parameter", detail, parameter="cursor")
    return created
