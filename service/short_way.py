"""The short way: how far a segmentation is, asked again and again by everyone who waits, answered before the routes.

To choose among fifty routes and solve a call's dependencies takes longer than the answer. Only the plain case is
answered here, with what `GET /v1/segmentations/{id}` (service/routes/segmentations.py) says too; all else is passed on.
"""

from dataclasses import dataclass

from redis.exceptions import RedisError
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from service.answers import text_answer
from service.backend import Backend

PREFIX = "/v1/segmentations/"
LONGEST = len(PREFIX) + 64


@dataclass(frozen=True)
class _Call:
    """What logs and metrics name a request by."""

    path: str


CALL = _Call(PREFIX + "{identifier}")


class ShortWay:
    """Inside of the guard, which has noted whose the request is."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a plain status read of a segmentation that waits for nothing; pass on everything else."""
        text = await _text(scope) if _plain(scope) else None
        if text is None:
            await self._app(scope, receive, send)
            return
        scope["route"] = CALL
        await text_answer(text)(scope, receive, send)


def _plain(scope: Scope) -> bool:
    if scope["type"] != "http" or scope["method"] != "GET" or scope["query_string"]:
        return False
    path: str = scope["path"]
    return path.startswith(PREFIX) and "/" not in path[len(PREFIX) :] and len(PREFIX) < len(path) < LONGEST


async def _text(scope: Scope) -> str | None:
    """The status document; None where there is more to do than to tell it."""
    if "prefer" in Headers(scope=scope):
        return None
    backend: Backend = scope["app"].state.backend
    visitor = scope["state"].get("visitor")
    if visitor is None:
        return None
    try:
        known = await backend.known(scope["path"][len(PREFIX) :], visitor.owner)
    except RedisError:
        return None  # the route says what is wrong
    return None if known is None or known.record.status == "queued" else known.text
