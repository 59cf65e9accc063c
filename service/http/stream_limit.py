"""How many event streams one may have open: each holds a connection, and asking for one is only one request."""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager

from starlette.requests import Request

from caesura.service.problems.status_table import Refusal

MOST_STREAMS = 200
"""Of one key and address, at one web process: more than anybody's tabs, and far fewer than there are connections."""

StreamClient = tuple[str, str]


class TooManyStreams(Refusal):
    """Close one, or ask for the status instead."""

    headers = {"Retry-After": "10"}  # noqa: RUF012  as every refusal has them, never changed


class StreamLimit:
    """The streams that are open, by whose they are."""

    def __init__(self) -> None:
        self._taken: Counter[StreamClient] = Counter()

    def check(self, who: StreamClient) -> None:
        """Raises `TooManyStreams` where one more would be too many."""
        if self._taken[who] >= MOST_STREAMS:
            detail = f"{MOST_STREAMS} event streams are open from here already. Close some, or ask for the status."
            raise TooManyStreams("too-many-streams", detail, limit=MOST_STREAMS)

    @contextmanager
    def taken(self, who: StreamClient) -> Iterator[None]:
        """While a stream is open."""
        self._taken[who] += 1
        try:
            yield
        finally:
            self._taken[who] -= 1
            if not self._taken[who]:
                del self._taken[who]


def stream_client(request: Request) -> StreamClient:
    """The key, where one is needed, and the address."""
    return request.state.visitor.key, request.client.host if request.client else ""
