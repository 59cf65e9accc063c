"""Whether the service lives, whether it can work, and what it has to do."""

from typing import Literal

from anyio import to_thread
from fastapi import APIRouter, Request, Response
from fastapi.responses import PlainTextResponse
from prometheus_client import CONTENT_TYPE_LATEST
from pydantic import BaseModel

from caesura.service.backend import BackendDependency
from caesura.service.metrics import Metrics
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.uploads.capacity import describe_unserved_queues, find_shortage

router = APIRouter(tags=["health"])


class HealthDocument(BaseModel):
    """The service answers, or is ready for work."""

    status: Literal["ok", "ready"]


@router.get("/healthz")
async def check_health() -> HealthDocument:
    """Tell whether the process answers."""
    return HealthDocument(status="ok")


@router.get("/readyz")
async def check_readiness(backend: BackendDependency) -> HealthDocument:
    """Tell whether the service can do its work.

    Redis, the disk and the store can be used and have room for more work, and warm workers take it from both queues;
    503 says what is missing.
    """
    wrong = await find_shortage(backend) or await describe_unserved_queues(backend)
    if wrong:
        raise RequestProblem("not-ready", wrong)
    return HealthDocument(status="ready")


@router.get("/metrics", response_class=PlainTextResponse)
async def get_metrics(request: Request, backend: BackendDependency) -> Response:
    """Report metrics for Prometheus.

    They count requests, queues, jobs and their stages, and the store. See docs/operations.md.
    """
    counted: Metrics = request.app.state.metrics
    text = await to_thread.run_sync(counted.text, backend)
    return Response(text, headers={"Content-Type": CONTENT_TYPE_LATEST})
