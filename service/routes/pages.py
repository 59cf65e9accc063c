"""The page: static files, a client of the API like any other."""

from anyio import Path as AsyncPath
from fastapi import APIRouter, FastAPI, Response
from fastapi.responses import HTMLResponse

from caesura.service.api_description.format_documents import list_formats_as_html
from caesura.service.http.security_headers import page_policy
from caesura.service.page.page_files import STATIC, PageFiles
from caesura.service.problems.problem_response import RequestProblem

FIRST_VIEW = 'data-view="start"'
"""Stands in the page for the view that is shown before its code is there."""

FORMATS = "<!-- formats -->"
"""Stands in the page for the kinds of files that can be dropped on it."""

router = APIRouter(include_in_schema=False)


@router.get("/")
@router.get("/collection/{identifier}")
async def page() -> Response:
    """The viewer; what it shows, it reads off its own address."""
    return await _viewer_response("start")


@router.get("/view/{identifier}")
async def result_page() -> Response:
    """The viewer at a result: it waits from the beginning, for to lay out the first screen in vain takes time."""
    return await _viewer_response("waiting")


async def _viewer_response(view: str) -> Response:
    index = AsyncPath(STATIC / "index.html")
    if not await index.is_file():
        raise RequestProblem("not-found", "The page is not installed here. The API is: see /openapi.json.")
    html = (await index.read_text(encoding="utf-8")).replace(FORMATS, list_formats_as_html())
    html = html.replace(FIRST_VIEW, f'data-view="{view}"', 1)
    return HTMLResponse(html, headers={"Content-Security-Policy": page_policy(html), "Cache-Control": "no-cache"})


@router.get("/docs")
async def api_reference() -> Response:
    """Every call of the API, to read and to try."""
    if not await AsyncPath(STATIC / "vendor" / "swagger-ui").is_dir():
        raise RequestProblem("not-found", "The page of the API is not installed here. The API is: see /openapi.json.")
    html = await AsyncPath(STATIC / "docs.html").read_text(encoding="utf-8")
    return HTMLResponse(html, headers={"Content-Security-Policy": page_policy(html), "Cache-Control": "no-cache"})


def mount_page_files(app: FastAPI) -> None:
    """Serve the page's own files, with ETag and Last-Modified."""
    app.mount("/static", PageFiles(), name="static")
