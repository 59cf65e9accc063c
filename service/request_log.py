"""One line and one count for every request, under one id: the client's `X-Request-Id` where it is one, else our own.

The id goes back in the answer, into the record of what was asked for, and from there into the worker's lines.
"""

import logging
import time

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from caesura.service.metrics import Metrics
from caesura.worker import logs

log = logging.getLogger("service.requests")

HEADER = "X-Request-Id"
FAILED = 400
RAW_HEADER = HEADER.lower().encode()
NO_ANSWER = 499
"""What is counted where the client had gone before an answer began."""

POLLED = frozenset({"/healthz", "/readyz", "/metrics", "/v1/segmentations/{identifier}"})
"""Asked again and again, by probes and by everyone who waits: counted, and told only where they fail."""


class RequestLogMiddleware:
    """The outermost layer: it sees what everything below has answered."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._app = app
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on; say how it ended and how long the answer's first byte took."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        began, status, seconds = time.perf_counter(), NO_ANSWER, 0.0
        with logs.log_context(request=logs.safe_request_id(headers.get(HEADER, ""))):

            async def watch(message: Message) -> None:
                nonlocal status, seconds
                if message["type"] == "http.response.start":
                    status, seconds = message["status"], time.perf_counter() - began
                    message["headers"] = [*message.get("headers", ()), (RAW_HEADER, logs.request_id().encode())]
                await send(message)

            try:
                await self._app(scope, receive, watch)
            finally:
                self._tell(scope, status, seconds or time.perf_counter() - began, waited="prefer" in headers)

    def _tell(self, scope: Scope, status: int, seconds: float, *, waited: bool) -> None:
        route = getattr(scope.get("route"), "path", "")
        self._metrics.request(scope["method"], route, status, None if waited else seconds)
        if route in POLLED and scope["method"] == "GET" and status < FAILED:
            return
        told = {"method": scope["method"], "path": scope["path"], "status": status, "ms": round(seconds * 1000, 1)}
        log.info("request", extra={"told": told})
