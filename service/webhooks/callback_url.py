"""The address of a webhook, checked when it is given: a client learns at once what will not be called."""

import httpcore
from anyio import to_thread

from caesura.core.errors import ParameterError
from caesura.service.backend import Backend
from caesura.service.http.outgoing.checked_connection import checked_addresses
from caesura.service.http.outgoing.target_url import parse_target_url
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.records.callbacks import MOST_CALLBACKS, add_callback


async def check_callback_url(backend: Backend, url: str) -> None:
    """Raises `ParameterError` for what is no address, `ForbiddenAddress` for one that is not called."""
    target = parse_target_url(url, "callback_url")
    try:
        await checked_addresses(backend.address_policy, target.host, target.port)
    except httpcore.ConnectError:
        detail = f"callback_url: the name {target.host} has no address."
        raise ParameterError("unknown-host", detail, parameter="callback_url") from None


async def register_callback(backend: Backend, segmentation: str, url: str) -> None:
    """Have the address called once the segmentation is over; at once where it is."""
    if not url:
        return
    if not await to_thread.run_sync(add_callback, backend.jobs.redis, segmentation, url):
        detail = f"{MOST_CALLBACKS} addresses wait for this segmentation, which is the limit."
        raise RequestProblem("too-many-callbacks", detail, limit=MOST_CALLBACKS)
