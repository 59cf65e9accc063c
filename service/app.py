"""The web application: it streams bytes, reads headers, queues ids and serves what is stored. It never computes."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version

from fastapi import Depends, FastAPI
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from caesura.service.api_description import openapi
from caesura.service.auth.middleware import AuthenticationMiddleware
from caesura.service.backend import open_backend
from caesura.service.http.query_names import refuse_unknown_names
from caesura.service.http.security_headers import SecurityHeadersMiddleware
from caesura.service.metrics import Metrics
from caesura.service.problems import exception_handlers
from caesura.service.request_log import RequestLogMiddleware
from caesura.service.routes import (
    animations,
    clips,
    health,
    methods_and_limits,
    pages,
    results,
    revisions,
    segmentations,
    session,
)
from caesura.service.settings import ServiceSettings
from caesura.service.uploads.body_limit import BodyLimit
from caesura.service.uploads.capacity import Capacity, require_capacity

FILES = ("application/octet-stream", "application/x-npz", "application/zip", "model/*")
"""Served by Range, or packed already: a compressed form would be another file."""


def create_app(settings: ServiceSettings) -> FastAPI:
    """The application, not yet connected: Redis and the store are opened when it starts."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with open_backend(settings) as backend:
            app.state.backend = backend
            app.openapi()  # takes half a second, which no request is to wait for
            yield

    app = FastAPI(
        title="Caesura",
        version=version("caesura"),
        lifespan=lifespan,
        docs_url=None,  # FastAPI's page loads scripts from another site
        redoc_url=None,
        redirect_slashes=False,  # a redirect would go to whatever host the client names
        generate_unique_id_function=openapi.operation_name,
    )
    app.state.capacity = Capacity()
    app.state.metrics = Metrics()
    exception_handlers.install_handlers(app)
    for routes in (animations, segmentations, results, revisions, clips, session, methods_and_limits, health):
        app.include_router(routes.router, dependencies=[Depends(refuse_unknown_names), Depends(require_capacity)])
    app.include_router(pages.router)
    pages.mount_page_files(app)
    openapi.install_description(app)
    app.add_middleware(BodyLimit, upload_bytes=settings.max_upload_bytes)
    app.add_middleware(GZipMiddleware, compresslevel=6, exclude_content_types=(*DEFAULT_EXCLUDED_CONTENT_TYPES, *FILES))
    app.add_middleware(AuthenticationMiddleware, settings=settings)
    app.add_middleware(SecurityHeadersMiddleware)
    app.add_middleware(RequestLogMiddleware, metrics=app.state.metrics)
    return app
