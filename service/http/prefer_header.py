"""The Prefer header (RFC 7240): how long the client would rather wait than ask again."""

import re

from fastapi import Request

LONGEST_WAIT_SECONDS = 30

_WAIT = re.compile(r"(?:^|[,;\s])wait\s*=\s*\"?(\d{1,6})\"?\s*(?:$|[,;])", re.IGNORECASE)


def preferred_wait_seconds(request: Request) -> int | None:
    """Seconds to wait, at most 30; None where none is preferred. What is not understood is ignored, as the RFC says."""
    match = _WAIT.search(",".join(request.headers.getlist("prefer")))
    return min(int(match[1]), LONGEST_WAIT_SECONDS) if match else None
