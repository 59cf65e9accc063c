"""Bounds the body of every request before any route reads it: an upload by the setting, all else as JSON."""

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from caesura.core.errors import LimitExceeded
from caesura.service.http.json_body import is_json
from caesura.service.uploads.multipart import OVERHEAD_BYTES, multipart_boundary

JSON_BYTES = 256 * 1024


class BodyTooLarge(LimitExceeded, HTTPException):
    """The body is too long. FastAPI turns any other error that is raised while it reads a body into a plain 400."""


class BodyLimit:
    """Raises `BodyTooLarge` where a route reads a body that is, or says to be, longer than its kind may be."""

    def __init__(self, app: ASGIApp, upload_bytes: int) -> None:
        self._app = app
        self._upload_bytes = upload_bytes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, and count the bytes on their way in."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        upload = _is_upload(scope["path"], headers)
        limit = self._upload_bytes if upload else JSON_BYTES
        form_bytes = OVERHEAD_BYTES if upload and multipart_boundary(headers.get("content-type", "")) else 0
        count, announced = 0, int(headers.get("content-length", 0))

        async def bounded() -> Message:
            nonlocal count
            message: Message = {} if announced > limit + form_bytes else await receive()
            count += len(message.get("body", b""))
            actual = max(count, announced)
            if actual > limit + form_bytes:
                raise _too_large(upload, limit, actual)
            return message

        await self._app(scope, bounded, send)


def _is_upload(path: str, headers: Headers) -> bool:
    if path in {"/v1/segmentations", "/v1/batches"}:
        return not is_json(headers)
    return path == "/v1/animations" or path.startswith("/v1/uploads/")


def _too_large(upload: bool, limit: int, actual: int) -> BodyTooLarge:
    if upload:
        return upload_too_large(limit, actual)
    detail = f"The JSON is longer than {limit} bytes. Send a file without the type application/json."
    return BodyTooLarge("json-too-long", detail, limit=limit, actual=actual)


def upload_too_large(limit: int, actual: int) -> BodyTooLarge:
    """The refusal of a file of more bytes than the service takes, whichever way it comes."""
    detail = (
        f"The upload is larger than the {limit} bytes this service takes. Send a smaller file, or ask its operator to "
        "raise CAESURA_MAX_UPLOAD_BYTES."
    )
    return BodyTooLarge("upload-too-large", detail, limit=limit, actual=actual, setting="CAESURA_MAX_UPLOAD_BYTES")
