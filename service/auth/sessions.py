"""Signing in: a browser gives its key once, and gets a cookie that no script can read and no other site can send.

The session's id is random, and Redis holds only its digest, with the digest of the key: a session ends when its time
is up, when it is signed out, or when its key is revoked.
"""

import hashlib
import secrets

import redis.asyncio
from starlette.requests import Request
from starlette.responses import Response

from caesura.worker.records import redis_keys

COOKIE = "caesura-session"
SESSION_SECONDS = 12 * 3600


async def begin_session(client: redis.asyncio.Redis, digest: str, request: Request, response: Response) -> None:
    """Sign in with the key of this digest; the cookie goes with the response."""
    identifier = secrets.token_urlsafe(32)
    await client.set(_session_digest(identifier), digest, ex=SESSION_SECONDS)
    response.set_cookie(
        COOKIE,
        identifier,
        max_age=SESSION_SECONDS,
        httponly=True,
        samesite="strict",
        secure=request.url.scheme == "https",
    )


async def key_digest(client: redis.asyncio.Redis, identifier: str) -> str | None:
    """The digest of the key that was given; None where there is no such session, or no longer."""
    kept = await client.get(_session_digest(identifier))
    return kept.decode() if isinstance(kept, bytes) else kept


async def end_session(client: redis.asyncio.Redis, request: Request, response: Response) -> None:
    """Sign out; nothing happens where nobody is signed in."""
    identifier = request.cookies.get(COOKIE)
    if identifier:
        await client.delete(_session_digest(identifier))
    response.delete_cookie(COOKIE, httponly=True, samesite="strict", secure=request.url.scheme == "https")


def _session_digest(identifier: str) -> str:
    return redis_keys.session_key(hashlib.sha256(identifier.encode()).hexdigest())
