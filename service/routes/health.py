"""Whether the service lives, whether it can work, and what it has to do."""

import os
import resource
import sys

from anyio import to_thread
from fastapi import APIRouter, Response
from fastapi.responses import JSONResponse, PlainTextResponse
from redis.exceptions import RedisError

from service.backend import Backend, Behind
from service.errors import Refusal

router = APIRouter(tags=["health"])


@router.get("/healthz")
async def alive() -> Response:
    """Whether the process answers."""
    return JSONResponse({"status": "ok"})


@router.get("/readyz")
async def ready(backend: Behind) -> Response:
    """Whether Redis and the data folder can be used; 503 says which cannot."""
    try:
        await to_thread.run_sync(_check, backend)
    except (RedisError, OSError) as fault:
        what = "Redis" if isinstance(fault, RedisError) else "the data folder"
        raise Refusal("not-ready", f"The service cannot use {what} just now. Try again shortly.") from fault
    return JSONResponse({"status": "ready"})


def _check(backend: Backend) -> None:
    backend.jobs.redis.ping()
    backend.spool.mkdir(parents=True, exist_ok=True)
    if not os.access(backend.spool, os.W_OK):
        raise PermissionError(f"{backend.spool} cannot be written")


@router.get("/metrics", response_class=PlainTextResponse)
async def metrics(backend: Behind) -> Response:
    """Prometheus' text form: jobs that wait, and the memory of this process."""
    depths = await to_thread.run_sync(backend.jobs.depths)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
    lines = [
        "# HELP caesura_queue_jobs Jobs that wait in a queue.",
        "# TYPE caesura_queue_jobs gauge",
        *(f'caesura_queue_jobs{{queue="{name}"}} {depth}' for name, depth in depths.items()),
        "# HELP caesura_web_peak_memory_bytes Largest resident memory of the web process.",
        "# TYPE caesura_web_peak_memory_bytes gauge",
        f"caesura_web_peak_memory_bytes {peak}",
    ]
    return PlainTextResponse("\n".join(lines) + "\n", media_type="text/plain; version=0.0.4")
