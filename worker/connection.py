"""A connection to Redis, and its answers as text."""

from collections.abc import Iterable
from typing import Any

import redis


def connect(url: str) -> redis.Redis:
    """A client for short calls; it connects at first use."""
    return redis.Redis.from_url(url, health_check_interval=30)


def names(values: Iterable[Any]) -> list[str]:
    """Redis's values as text; redis-py types them `bytes | str`, but without `decode_responses` they are bytes."""
    return [bytes(value).decode() for value in values]
