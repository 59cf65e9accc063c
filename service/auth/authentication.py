"""Who asks: somebody with a key, a browser that is signed in, or nobody known."""

from dataclasses import dataclass

from starlette.requests import Request

from caesura.service.api_keys.credentials import KeyRecord, digest_of
from caesura.service.auth import sessions
from caesura.service.backend import Backend
from caesura.worker.records import redis_keys


@dataclass(frozen=True)
class Caller:
    """Whose the request is. `key` is the digest of the key, empty where none was needed; `metrics` as the key."""

    owner: str
    key: str = ""
    by_cookie: bool = False
    metrics: bool = False


async def authenticate(backend: Backend, request: Request) -> Caller | None:
    """By the key in `Authorization`, else by the session of the cookie; None where neither is known."""
    scheme, _, key = request.headers.get("authorization", "").partition(" ")
    if scheme:
        record = await find_key(backend, digest_of(key.strip())) if scheme.lower() == "bearer" else None
        return None if record is None else Caller(record.owner, record.digest, metrics=record.metrics)
    identifier = request.cookies.get(sessions.COOKIE)
    digest = await sessions.key_digest(backend.records.redis, identifier) if identifier else None
    record = await find_key(backend, digest) if digest else None
    return None if record is None else Caller(record.owner, record.digest, True, record.metrics)


async def is_still_admitted(backend: Backend, request: Request) -> bool:
    """Whether who was let in with this request would be now: the key not revoked, the session not signed out."""
    known: Caller = request.state.visitor
    return not known.key or await authenticate(backend, request) == known


async def find_key(backend: Backend, digest: str) -> KeyRecord | None:
    """The key of this digest, of the file or of Redis; None where it was never made, or revoked."""
    return backend.key_file.find(digest) or KeyRecord.read(
        await backend.records.redis.get(redis_keys.api_key_key(digest))
    )
