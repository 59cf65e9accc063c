"""The page's files as they are served: compressed, its modules joined, and asked for anew each time."""

import gzip
import hashlib
import os
from collections.abc import Callable
from pathlib import Path

from starlette.datastructures import Headers
from starlette.responses import FileResponse, Response
from starlette.staticfiles import NotModifiedResponse, StaticFiles
from starlette.types import Scope

from caesura.service.page.joined_modules import ENTRIES, join_modules

STATIC = Path(__file__).resolve().parent.parent / "static"
VIEWER = STATIC / "viewer"
JAVASCRIPT = "text/javascript"


class PageFiles(StaticFiles):
    """Files that a browser asks for anew each time (304 where they are the same): after an upgrade none is old."""

    def __init__(self) -> None:
        super().__init__(directory=STATIC, check_dir=False)
        self._made: dict[str, tuple[int, bytes]] = {}

    def file_response(
        self, full_path: str | os.PathLike[str], stat_result: os.stat_result, scope: Scope, status_code: int = 200
    ) -> Response:
        """The file, compressed where that is understood, or that it has not changed."""
        asked = Headers(scope=scope)
        packed = "gzip" in asked.get("accept-encoding", "") and "range" not in asked
        path = Path(full_path)
        entry = path.relative_to(VIEWER).as_posix() if path.is_relative_to(VIEWER) else ""
        if entry in ENTRIES:
            response = self._joined_response(entry, asked, packed=packed)
        else:
            response = super().file_response(full_path, stat_result, scope, status_code)
            if isinstance(response, FileResponse) and packed:
                headers = {"ETag": response.headers["etag"], "Last-Modified": response.headers["last-modified"]}
                body = self._once(str(path), stat_result.st_mtime_ns, lambda: _pack(path.read_bytes()))
                response = _packed_response(body, headers, response.media_type)
        response.headers["Cache-Control"] = "no-cache"
        return response

    def _joined_response(self, entry: str, asked: Headers, *, packed: bool) -> Response:
        """An entry with the modules that it imports."""
        changed = max(path.stat().st_mtime_ns for path in VIEWER.rglob("*"))
        text = self._once(entry, changed, lambda: join_modules(VIEWER, entry).encode())
        headers = {"ETag": f'"{hashlib.sha256(text).hexdigest()[:32]}"'}
        if self.is_not_modified(Headers(headers), asked):
            return NotModifiedResponse(Headers(headers))
        if not packed:
            return Response(text, 200, headers, JAVASCRIPT)
        return _packed_response(self._once(f"{entry}.gz", changed, lambda: _pack(text)), headers, JAVASCRIPT)

    def _once(self, name: str, changed: int, make: Callable[[], bytes]) -> bytes:
        """What `make` answers, made once for as long as its source stays as it is."""
        known = self._made.get(name)
        if known is None or known[0] != changed:
            known = self._made[name] = (changed, make())
        return known[1]


def _pack(data: bytes) -> bytes:
    """As gzip, which takes ten times as long as the sending."""
    return gzip.compress(data, 6, mtime=0)


def _packed_response(body: bytes, headers: dict[str, str], media_type: str | None) -> Response:
    return Response(body, 200, headers | {"Content-Encoding": "gzip", "Vary": "Accept-Encoding"}, media_type)
