"""HEAD wherever GET is: the same answer, without its body.

The call below sees a GET, so that status and headers are the same. Once it has sent them it is ended: a file is not
read, and an event stream does not go on.
"""

from anyio import CancelScope
from starlette.types import ASGIApp, Message, Receive, Scope, Send


class HeadMiddleware:
    """Answers HEAD as GET would be answered."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on; of a HEAD keep the head of the answer."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self._app(scope, receive, send)
            return
        with CancelScope() as call:

            async def send_head(message: Message) -> None:
                if message["type"] == "http.response.start":
                    await send(message)
                    await send({"type": "http.response.body", "body": b""})
                    call.cancel()

            inner = {**scope, "method": "GET"}
            try:
                await self._app(inner, receive, send_head)
            finally:
                if "route" in inner:  # the log names a request by its route
                    scope["route"] = inner["route"]
