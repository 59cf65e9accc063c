"""A limit of open event streams for each client, for each stream holds a connection."""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager

from starlette.requests import Request

from caesura.service.problems.problem_response import RequestProblem

MOST_STREAMS = 200
"""Of one key and address, at one web process: more than anybody's tabs, and far fewer than there are connections."""

StreamClient = tuple[str, str]


class TooManyStreams(RequestProblem):
    """Close one, or ask for the status instead."""

    headers = {"Retry-After": "10"}  # noqa: RUF012  as every refusal has them, never changed


class StreamLimit:
    """The streams that are open, by whose they are."""

    def __init__(self) -> None:
        self._taken: Counter[StreamClient] = Counter()

    def check(self, who: StreamClient) -> None:
        """Raises `TooManyStreams` where one more would be too many."""
        if self._taken[who] >= MOST_STREAMS:
            detail = f"{MOST_STREAMS} event streams of this client are open already. Close some, or ask for the status."
            raise TooManyStreams("too-many-streams", detail, limit=MOST_STREAMS)

    @contextmanager
    def open_stream(self, who: StreamClient) -> Iterator[None]:
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
