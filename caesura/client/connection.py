"""How a service is connected to, and an answer of httpx in the terms of `exchange`."""

from typing import Any

from caesura.client.errors import Unreachable
from caesura.client.exchange import ANSWER_SECONDS, CONNECT_SECONDS, Answer, base_url

try:
    import httpx
except ModuleNotFoundError as missing:
    raise ModuleNotFoundError(
        'httpx is not installed, which a client needs: pip install "caesura[client]".', name=missing.name
    ) from None


TransportError = httpx.TransportError


def connect(url: str, key: str) -> httpx.Client:
    """Connections that one thread asks through."""
    return httpx.Client(**_options(url, key))


def connect_async(url: str, key: str) -> httpx.AsyncClient:
    """Connections that an event loop asks through."""
    return httpx.AsyncClient(**_options(url, key))


def _options(url: str, key: str) -> dict[str, Any]:
    return {
        "headers": {"Authorization": f"Bearer {key}"} if key else {},
        "base_url": base_url(url),
        "timeout": httpx.Timeout(ANSWER_SECONDS, connect=CONNECT_SECONDS),
        "trust_env": False,  # no proxy stands between a program and the service it is told
    }


def as_answer(response: httpx.Response) -> Answer:
    """The answer, read whole."""
    document = None
    if "json" in response.headers.get("Content-Type", ""):
        try:
            document = response.json()
        except ValueError:
            document = None
    found = document if isinstance(document, dict) else None
    return Answer(response.status_code, response.headers, response.content, found)


def no_answer(url: str, fault: httpx.TransportError) -> Unreachable:
    """What is said where nobody answers."""
    return Unreachable("unreachable", f"No answer from {base_url(url)}: {fault or type(fault).__name__}.")
