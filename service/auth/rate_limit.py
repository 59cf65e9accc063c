"""The rate limit: a token bucket for each key and address, kept in Redis and shared by all services.

A bucket holds a minute's worth of requests and fills at that rate: bursts pass, floods wait. Redis's own clock
counts, so the clocks of the services do not matter.
"""

import math
from dataclasses import dataclass
from ipaddress import IPv6Address, ip_address

import redis.asyncio

from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.records import redis_keys

WINDOW_SECONDS = 60

SCRIPT = """
local capacity, rate = tonumber(ARGV[1]), tonumber(ARGV[2])
local time = redis.call('TIME')
local now = time[1] + time[2] / 1000000
local kept = redis.call('HMGET', KEYS[1], 'tokens', 'at')
local passed = math.max(0, now - (tonumber(kept[2]) or now))
local tokens = math.min(capacity, (tonumber(kept[1]) or capacity) + passed * rate)
local admitted = 0
if tokens >= 1 then tokens, admitted = tokens - 1, 1 end
redis.call('HSET', KEYS[1], 'tokens', string.format('%.6f', tokens), 'at', string.format('%.6f', now))
redis.call('PEXPIRE', KEYS[1], math.ceil(capacity / rate * 1000) + 1000)
return {admitted, string.format('%.6f', tokens)}
"""


@dataclass(frozen=True)
class RateAllowance:
    """What is left of a bucket after a request."""

    limit: int
    tokens: float

    def headers(self) -> dict[str, str]:
        """The same for the client, in the form of draft-ietf-httpapi-ratelimit-headers."""
        left = int(self.tokens)
        seconds = math.ceil((self.limit - self.tokens) * WINDOW_SECONDS / self.limit)
        return {
            "RateLimit-Policy": f'"requests";q={self.limit};w={WINDOW_SECONDS}',
            "RateLimit": f'"requests";r={left};t={seconds}',
        }


class TooManyRequests(RequestProblem):
    """Ask again later; `headers` say when."""

    def __init__(self, allowed: RateAllowance) -> None:
        wait = max(1, math.ceil((1 - allowed.tokens) * WINDOW_SECONDS / allowed.limit))
        detail = f"More than {allowed.limit} requests in a minute. Ask again in {wait} s."
        super().__init__("too-many-requests", detail, limit=allowed.limit, setting="CAESURA_REQUESTS_A_MINUTE")
        self.headers = {**allowed.headers(), "Retry-After": str(wait)}


async def take_token(client: redis.asyncio.Redis, who: str, address: str, limit: int) -> RateAllowance:
    """Take one request of `limit` a minute out of the bucket of a key (its digest, or none) and an address."""
    bucket = redis_keys.rate_key(who, _network(address))
    admitted, tokens = await client.register_script(SCRIPT)([bucket], [limit, limit / WINDOW_SECONDS])
    allowed = RateAllowance(limit, float(tokens))
    if not admitted:
        raise TooManyRequests(allowed)
    return allowed


def _network(address: str) -> str:
    """Who has one IPv6 address has its whole /64."""
    try:
        parsed = ip_address(address)
    except ValueError:
        return "none"
    return str(IPv6Address(int(parsed) >> 64 << 64)) if isinstance(parsed, IPv6Address) else str(parsed)
