"""A connection to Redis, and its answers as text."""

import math
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar, cast

import redis
from redis.client import Pipeline

Answer = TypeVar("Answer")

LOOK_SECONDS = 0.2


def connect(url: str) -> redis.Redis:
    """A client for short calls; it connects at first use."""
    return redis.Redis.from_url(url, health_check_interval=30)


def transact(client: redis.Redis, write: Callable[[Pipeline], Answer], *watched: str) -> Answer:
    """Call `write`, whose changes are one MULTI; again where another process changes a watched key meanwhile."""
    return cast("Answer", client.transaction(cast("Any", write), *watched, value_from_callable=True))


def decode_names(values: Iterable[Any]) -> list[str]:
    """Redis's values as text; redis-py types them `bytes | str`, but without `decode_responses` they are bytes."""
    return [bytes(value).decode() for value in values]


def refuses_writes(error: Exception) -> bool:
    """Whether Redis answered that it takes no writes, not even deletions: its file is on a full disk."""
    return isinstance(error, redis.ResponseError) and "MISCONF " in str(error)


@contextmanager
def tolerate_full_disk() -> Iterator[None]:
    """Skip the rest of the block where Redis refuses a write because its disk is full."""
    try:
        yield
    except redis.ResponseError as error:
        if not refuses_writes(error):
            raise


def await_writable(client: redis.Redis, seconds: float = math.inf) -> None:
    """Wait until Redis takes writes; raises its refusal after so many seconds. It tries its file again every second."""
    deadline = time.monotonic() + seconds
    while True:
        try:
            client.ping()  # refused as a write is
        except redis.ResponseError as error:
            if not refuses_writes(error) or time.monotonic() > deadline:
                raise
            time.sleep(LOOK_SECONDS)
        else:
            return
