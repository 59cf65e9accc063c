"""Bodies that come as gzip (`Content-Encoding: gzip`), inflated as they stream, in pieces of bounded size.

What comes out counts against the same limit as a body that came as it is, and so does what goes in: a small body that
inflates to terabytes is refused as soon as it passes the limit. So is one of very many members with hardly a byte in
each: every one costs as much time as a piece.
"""

import zlib

from anyio import to_thread
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from caesura.service.problems.problem_response import RequestProblem
from caesura.service.uploads.body_limit import BodyLimit

PIECE_BYTES = 2**18
FEW_MEMBERS, LEAST_MEMBER_BYTES = 1000, 64
"""So many members may be of any size; more must have so many bytes each in the mean. Programs write 64 KiB and more."""
GZIP_WINDOW = 16 + zlib.MAX_WBITS
ENCODINGS = frozenset({"gzip", "x-gzip"})
AS_IT_IS = frozenset({"", "identity"})


class UnreadableEncoding(RequestProblem, HTTPException):  # type: ignore[misc]  # both have `headers`, of one use
    """The body is not encoded as it says, or in a way that is not read here.

    FastAPI turns any other error that is raised while it reads a body into a plain 400.
    """

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(code, detail)
        self.headers = {"Accept-Encoding": "gzip"}


class InflateMiddleware:
    """Inflates bodies on their way in. It stands within a `BodyLimit`, and has one of its own for what comes out."""

    def __init__(self, app: ASGIApp, upload_bytes: int) -> None:
        self._app = app
        self._limited = BodyLimit(app, upload_bytes)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on; where the body is encoded, as if it were not."""
        given = dict(scope.get("headers", ())).get(b"content-encoding", b"")
        encoding = given.decode("latin-1").strip().lower()
        if encoding in AS_IT_IS:
            await self._app(scope, receive, send)
            return
        body = InflatedBody(receive, known=encoding in ENCODINGS)
        headers = [pair for pair in scope["headers"] if pair[0] not in {b"content-encoding", b"content-length"}]
        await self._limited({**scope, "headers": headers}, body.receive, send)


class InflatedBody:
    """A body that is read piece by piece."""

    def __init__(self, receive: Receive, *, known: bool) -> None:
        self._receive = receive
        self._known = known
        self._inflater = zlib.decompressobj(GZIP_WINDOW)
        self._rest = b""
        self._more = True
        self._taken = self._members = 0

    async def receive(self) -> Message:
        """The next piece; raises `UnreadableEncoding` where there is none that can be read."""
        if not self._known:
            raise UnreadableEncoding("unsupported-encoding", "The body must come as it is, or as gzip.")
        while True:
            if self._rest:
                piece = await to_thread.run_sync(self._inflate)
                if piece:
                    return {"type": "http.request", "body": piece, "more_body": True}
            elif self._more:
                message = await self._receive()
                if message["type"] != "http.request":
                    return message
                self._rest, self._more = message.get("body", b""), message.get("more_body", False)
                self._taken += len(self._rest)
            else:
                if not self._inflater.eof:
                    raise _broken("it ends too early")
                return {"type": "http.request", "body": b"", "more_body": False}

    def _inflate(self) -> bytes:
        if self._inflater.eof:  # the next member: several in a row are one file
            self._inflater = zlib.decompressobj(GZIP_WINDOW)
            self._members += 1
            if self._members > FEW_MEMBERS and self._members * LEAST_MEMBER_BYTES > self._taken:
                raise _broken("it is made of too many small members")
        try:
            piece = self._inflater.decompress(self._rest, PIECE_BYTES)
        except zlib.error as fault:
            raise _broken(str(fault)) from None
        self._rest = self._inflater.unused_data if self._inflater.eof else self._inflater.unconsumed_tail
        return piece


def _broken(why: str) -> UnreadableEncoding:
    detail = f"The body is no gzip that can be read: {why}. Send it again, whole, or without Content-Encoding."
    return UnreadableEncoding("malformed-gzip", detail)
