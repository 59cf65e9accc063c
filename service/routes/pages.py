"""The page: static files, a client of the API like any other."""

import gzip
import os
from pathlib import Path

from anyio import Path as AsyncPath
from fastapi import APIRouter, FastAPI, Response
from fastapi.responses import HTMLResponse
from starlette.datastructures import Headers
from starlette.responses import FileResponse
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from caesura.service.api_description.format_documents import list_formats_as_html
from caesura.service.http.security_headers import page_policy
from caesura.service.problems.problem_response import RequestProblem

STATIC = Path(__file__).resolve().parent.parent / "static"

FORMATS = "<!-- formats -->"
"""Stands in the page for the kinds of files that can be dropped on it."""

router = APIRouter(include_in_schema=False)


@router.get("/")
@router.get("/view/{identifier}")
@router.get("/collection/{identifier}")
async def page() -> Response:
    """The viewer; what it shows, it reads off its own address."""
    index = AsyncPath(STATIC / "index.html")
    if not await index.is_file():
        raise RequestProblem("not-found", "The page is not installed here. The API is: see /openapi.json.")
    html = (await index.read_text(encoding="utf-8")).replace(FORMATS, list_formats_as_html())
    return HTMLResponse(html, headers={"Content-Security-Policy": page_policy(html), "Cache-Control": "no-cache"})


@router.get("/docs")
async def api_reference() -> Response:
    """Every call of the API, to read and to try."""
    if not await AsyncPath(STATIC / "vendor" / "swagger-ui").is_dir():
        raise RequestProblem("not-found", "The page of the API is not installed here. The API is: see /openapi.json.")
    html = await AsyncPath(STATIC / "docs.html").read_text(encoding="utf-8")
    return HTMLResponse(html, headers={"Content-Security-Policy": page_policy(html), "Cache-Control": "no-cache"})


class PageFiles(StaticFiles):
    """Files that a browser asks for anew each time (304 where they are the same): after an upgrade none is old."""

    def file_response(
        self, full_path: str | os.PathLike[str], stat_result: os.stat_result, scope: Scope, status_code: int = 200
    ) -> Response:
        """The file, compressed where that is understood, or that it has not changed."""
        response = super().file_response(full_path, stat_result, scope, status_code)
        asked = Headers(scope=scope)
        if isinstance(response, FileResponse) and "gzip" in asked.get("accept-encoding", "") and "range" not in asked:
            headers = {"ETag": response.headers["etag"], "Last-Modified": response.headers["last-modified"]}
            headers |= {"Content-Encoding": "gzip", "Vary": "Accept-Encoding"}
            body = _compressed(str(full_path), stat_result.st_mtime_ns)
            response = Response(body, status_code, headers, response.media_type)
        response.headers["Cache-Control"] = "no-cache"
        return response


def _compressed(path: str, changed: int) -> bytes:
    """A file of the page as gzip, made once for as long as it stays as it is: making takes ten times the sending."""
    known = _compressed_files.get(path)
    if known is None or known[0] != changed:
        known = _compressed_files[path] = (changed, gzip.compress(Path(path).read_bytes(), 6, mtime=0))
    return known[1]


_compressed_files: dict[str, tuple[int, bytes]] = {}


def mount_page_files(app: FastAPI) -> None:
    """Serve the page's own files, with ETag and Last-Modified."""
    app.mount("/static", PageFiles(directory=STATIC, check_dir=False), name="static")
