"""Whether the service lives, whether it can work, and what it has to do."""

from anyio import to_thread
from fastapi import APIRouter, Request, Response
from fastapi.responses import JSONResponse, PlainTextResponse
from prometheus_client import CONTENT_TYPE_LATEST

from caesura.service.backend import BackendDependency
from caesura.service.metrics import Metrics
from caesura.service.problems.status_table import Refusal
from caesura.service.uploads.capacity import idle, look_for_capacity

router = APIRouter(tags=["health"])


@router.get("/healthz")
async def alive() -> Response:
    """Whether the process answers."""
    return JSONResponse({"status": "ok"})


@router.get("/readyz")
async def ready(backend: BackendDependency) -> Response:
    """Whether Redis, the disk and the store can be used and have room for more work, and whether warm workers take it

    from both queues; 503 says what is missing.
    """
    wrong = await look_for_capacity(backend) or await idle(backend)
    if wrong:
        raise Refusal("not-ready", wrong)
    return JSONResponse({"status": "ready"})


@router.get("/metrics", response_class=PlainTextResponse)
async def metrics(request: Request, backend: BackendDependency) -> Response:
    """For Prometheus: requests, queues, jobs and their stages, the store. See docs/operations.md."""
    counted: Metrics = request.app.state.metrics
    text = await to_thread.run_sync(counted.text, backend)
    return Response(text, headers={"Content-Type": CONTENT_TYPE_LATEST})
