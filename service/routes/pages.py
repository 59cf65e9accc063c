"""The page: static files, a client of the API like any other."""

from pathlib import Path
from typing import Any

from anyio import Path as AsyncPath
from fastapi import APIRouter, FastAPI, Response
from fastapi.responses import HTMLResponse
from starlette.staticfiles import StaticFiles

from service.errors import Refusal
from service.security import page_policy

STATIC = Path(__file__).resolve().parent.parent / "static"

router = APIRouter(include_in_schema=False)


@router.get("/")
@router.get("/view/{identifier}")
async def page() -> Response:
    """The viewer; what it shows, it reads off its own address."""
    index = AsyncPath(STATIC / "index.html")
    if not await index.is_file():
        raise Refusal("not-found", "The page is not installed here. The API is: see /openapi.json.")
    html = await index.read_text(encoding="utf-8")
    return HTMLResponse(html, headers={"Content-Security-Policy": page_policy(html), "Cache-Control": "no-cache"})


class PageFiles(StaticFiles):
    """Files that a browser asks for anew each time (304 where they are the same): after an upgrade none is old."""

    def file_response(self, *args: Any, **kwargs: Any) -> Response:
        """The file, or that it has not changed."""
        response = super().file_response(*args, **kwargs)
        response.headers["Cache-Control"] = "no-cache"
        return response


def mount(app: FastAPI) -> None:
    """Serve the page's own files, with ETag and Last-Modified."""
    app.mount("/static", PageFiles(directory=STATIC, check_dir=False), name="static")
