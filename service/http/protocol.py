"""HTTP as uvicorn speaks it, with limits: to the length of a head, and to how long a client may say or take nothing.

None needs a key, so none may cost memory, or a connection for longer than a moment.
"""

import asyncio
import http
import json
import socket
import sys
from typing import Any

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from caesura.service.problems.problem_response import MEDIA_TYPE

MOST_HEAD_BYTES = 64 * 1024
"""Of a request's head, and of what follows a body. A longer head that comes in one piece is read all the same."""

MOST_UNSENT_BYTES = 128 * 1024
"""That the kernel holds of an answer, beside what is under way; else megabytes for a client that reads nothing."""

TOO_LARGE = {
    "type": "urn:caesura:problem:head-too-large",
    "title": "Request head too large",
    "status": 431,
    "kind": "request",
    "code": "head-too-large",
    "detail": f"The head of the request is longer than {MOST_HEAD_BYTES} bytes. Send shorter headers, or fewer.",
    "limit": MOST_HEAD_BYTES,
}


class Protocol(HttpToolsProtocol):
    """One connection."""

    head_seconds = 30.0
    """For the whole head, from the connection or from its first byte on."""
    body_seconds = 60.0
    """Between two pieces of a body that we are waiting for."""
    write_seconds = 60.0
    """Before a client that takes nothing of its answer is dropped. Linux keeps this time; elsewhere nobody does."""
    look_seconds = 5.0

    _deadline_timer: asyncio.TimerHandle | None = None
    _reading = "head"  # and "body", and "nothing": between two requests uvicorn keeps the time
    _unread = 0
    _began = _heard = 0.0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as uvicorn has it
        """Somebody came."""
        super().connection_made(transport)
        if sys.platform == "linux":
            tcp = transport.get_extra_info("socket")
            tcp.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, int(self.write_seconds * 1000))
            tcp.setsockopt(socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, MOST_UNSENT_BYTES)
        self._began = self._heard = self.loop.time()
        self._deadline_timer = self.loop.call_later(self.look_seconds, self._look)

    def connection_lost(self, exc: Exception | None) -> None:
        """And has left."""
        if self._deadline_timer is not None:
            self._deadline_timer.cancel()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Read on; end it where all of this is head."""
        self._unread += len(data)
        self._heard = self.loop.time()
        super().data_received(data)
        if self._unread > MOST_HEAD_BYTES and not self.transport.is_closing():
            self._refuse()
        elif self._deadline_timer is None and self._reading != "nothing":
            self._deadline_timer = self.loop.call_later(self.look_seconds, self._look)

    def on_message_begin(self) -> None:
        """The first byte of a request."""
        self._reading, self._began = "head", self.loop.time()
        super().on_message_begin()

    def on_headers_complete(self) -> None:
        """The head is whole."""
        self._reading, self._unread = "body", 0
        super().on_headers_complete()

    def on_body(self, body: bytes) -> None:
        """A piece of the body."""
        self._unread = 0
        super().on_body(body)

    def on_message_complete(self) -> None:
        """The request is whole."""
        self._reading, self._unread = "nothing", 0
        super().on_message_complete()

    def _look(self) -> None:
        """Every few seconds while a request is not whole."""
        self._deadline_timer = None
        if self._reading == "nothing" or self.transport.is_closing():
            return
        now = self.loop.time()
        late = now - self._began > self.head_seconds
        if self._reading == "body":
            late = now - self._heard > self.body_seconds and not self.flow.read_paused
        if late:
            self.transport.close()
        else:
            self._deadline_timer = self.loop.call_later(self.look_seconds, self._look)

    def _refuse(self) -> None:
        """Say so, where no answer is on its way, and hang up."""
        if self.cycle is None or self.cycle.response_complete:
            self.transport.write(_answer(TOO_LARGE))
        self.transport.close()


def _answer(problem: dict[str, Any]) -> bytes:
    body = json.dumps(problem).encode()
    status = http.HTTPStatus(problem["status"])
    head = f"HTTP/1.1 {status.value} {status.phrase}\r\ncontent-type: {MEDIA_TYPE}\r\ncache-control: no-store\r\n"
    return f"{head}content-length: {len(body)}\r\nconnection: close\r\n\r\n".encode() + body
