"""The web application: it streams bytes, reads headers, queues ids and serves what is stored. It never computes."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version

from anyio import create_task_group
from fastapi import Depends, FastAPI
from starlette.middleware.cors import CORSMiddleware

from caesura.service.api_description import openapi
from caesura.service.auth.middleware import AuthenticationMiddleware
from caesura.service.backend import open_backend
from caesura.service.http.compression import CompressMiddleware, choose_compressed_types
from caesura.service.http.head_requests import HeadMiddleware
from caesura.service.http.query_names import refuse_unknown_names
from caesura.service.http.security_headers import SecurityHeadersMiddleware
from caesura.service.metrics import Metrics
from caesura.service.problems import exception_handlers
from caesura.service.request_log import RequestLogMiddleware
from caesura.service.routes import (
    animations,
    batches,
    callback_secret,
    clips,
    collection_proposals,
    collection_searches,
    collection_takes,
    collections,
    health,
    methods_and_limits,
    pages,
    pictures,
    results,
    resumable_uploads,
    revisions,
    segmentations,
    session,
)
from caesura.service.settings import ServiceSettings
from caesura.service.uploads.body_limit import BodyLimit
from caesura.service.uploads.capacity import Capacity, require_capacity
from caesura.service.uploads.content_encoding import InflateMiddleware
from caesura.service.webhooks.delivery_loop import DeliveryLoop

ROUTES = (
    animations, resumable_uploads, segmentations, batches, results, pictures, revisions, clips, collections,
    collection_takes, collection_proposals, collection_searches, callback_secret, session, methods_and_limits, health,
)  # fmt: skip

EXPOSED = (
    "Content-Disposition", "Content-Location", "ETag", "Location", "Preference-Applied", "RateLimit", "Retry-After",
    "Tus-Resumable", "Tus-Version", "Upload-Expires", "Upload-Length", "Upload-Offset", "X-Request-Id",
)  # fmt: skip
"""Headers that pages of other sites may read, where the operator lets them ask at all."""


def create_app(settings: ServiceSettings) -> FastAPI:
    """The application, not yet connected: Redis and the store are opened when it starts."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with open_backend(settings) as backend:
            app.state.backend = backend
            app.openapi()  # takes half a second, which no request is to wait for
            async with create_task_group() as tasks:
                tasks.start_soon(DeliveryLoop(backend).run)
                yield
                tasks.cancel_scope.cancel()

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
    for routes in ROUTES:
        app.include_router(routes.router, dependencies=[Depends(refuse_unknown_names), Depends(require_capacity)])
    app.include_router(pages.router)
    pages.mount_page_files(app)
    openapi.install_description(app)
    app.add_middleware(InflateMiddleware, upload_bytes=settings.max_upload_bytes)
    app.add_middleware(BodyLimit, upload_bytes=settings.max_upload_bytes)
    choose_compressed_types()
    app.add_middleware(CompressMiddleware, brotli=False)
    app.add_middleware(HeadMiddleware)
    app.add_middleware(AuthenticationMiddleware, settings=settings)
    if settings.page_origins:
        app.add_middleware(
            CORSMiddleware,
            allow_origins=settings.page_origins,
            allow_methods=("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE"),
            allow_headers=("*",),
            expose_headers=EXPOSED,
        )
    app.add_middleware(SecurityHeadersMiddleware)
    app.add_middleware(RequestLogMiddleware, metrics=app.state.metrics)
    return app
