"""Serving stored bytes: whole or by Range, with an ETag, so that players seek and downloads resume."""

import re
from dataclasses import dataclass
from typing import Literal
from urllib.parse import quote

from fastapi import Request, Response
from fastapi.responses import StreamingResponse

from caesura.service.http.file_name import plain_name
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.store.blobs import Blobs

OCTETS = "application/octet-stream"
"""Every file comes as this too where `Accept` names nothing else: generated clients read it as bytes."""

_RANGE = re.compile(r"bytes=(\d{0,18})-(\d{0,18})")
"""More digits than any file has bytes are not understood, and so ignored: thousands of them are no number to Python."""


@dataclass(frozen=True)
class StoredFile:
    """A blob to send: where it is, what it is, what to call it once saved, and the tag of exactly these bytes."""

    key: str
    size: int
    media_type: str
    filename: str
    etag: str


def parse_range(header: str, size: int) -> tuple[int, int] | None:
    """Bytes [start, end) of a Range header; None for the whole (also where several ranges are asked for).

    Raises `RequestProblem` ("range-not-satisfiable") for a range beyond the end.
    """
    match = _RANGE.fullmatch(header.strip())
    if not match or match.groups() == ("", ""):
        return None
    first, last = match.groups()
    start, end = (int(first), int(last) + 1 if last else size) if first else (max(size - int(last), 0), size)
    end = min(end, size)
    if start >= size or start >= end:
        raise RequestProblem(
            "range-not-satisfiable", f"The file has {size} bytes; {header} is beyond them.", actual=size
        )
    return start, end


def is_not_modified(request: Request, etag: str) -> bool:
    """Whether the client already has what carries this tag."""
    tags = {tag.strip().removeprefix("W/") for tag in request.headers.get("if-none-match", "").split(",")}
    return etag.removeprefix("W/") in tags or "*" in tags


def cache_headers(etag: str) -> dict[str, str]:
    """Headers of a body that never changes under its id: keep it, but ask before using it (it may be deleted)."""
    return {"ETag": etag, "Cache-Control": "private, no-cache"}


def content_disposition(filename: str, how: Literal["attachment", "inline"] = "attachment") -> str:
    """The header that names a download, in plain letters too: curl reads no `filename*`.

    A browser shows what comes `inline`, and saves it by this name where a person asks for that.
    """
    name = plain_name(filename) or "download"
    plain = re.sub(r"[^A-Za-z0-9 ._()+-]", "_", name)
    return f"{how}; filename=\"{plain}\"; filename*=UTF-8''{quote(name, safe='')}"


def accepted_type(request: Request, media_type: str) -> str:
    """What a file is sent as: plain bytes where the client accepts nothing else, as generated clients do."""
    return OCTETS if request.headers.get("accept", "").strip().lower() == OCTETS else media_type


def stored_response(request: Request, blobs: Blobs, stored: StoredFile) -> Response:
    """The blob, or the range of it that was asked for, or 304."""
    headers = cache_headers(stored.etag) | {
        "Accept-Ranges": "bytes",
        "Vary": "Accept",
        "Content-Disposition": content_disposition(stored.filename),
    }
    if is_not_modified(request, stored.etag):
        return Response(status_code=304, headers=headers)
    wanted = None
    if request.headers.get("if-range", stored.etag) == stored.etag:
        wanted = parse_range(request.headers.get("range", ""), stored.size)
    start, end = wanted or (0, stored.size)
    headers["Content-Length"] = str(end - start)
    if wanted:
        headers["Content-Range"] = f"bytes {start}-{end - 1}/{stored.size}"
    content = blobs.stream(stored.key, start, end)
    return StreamingResponse(content, 206 if wanted else 200, headers, accepted_type(request, stored.media_type))
