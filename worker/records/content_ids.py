"""Ids made of content: the same file and the same choices are the same id, and nobody else can work it out.

BLAKE2b, keyed with a secret of the installation (RFC 7693, section 2.9): without the key, having a file does not
give its id, so an id is as hard to guess as a random one.
"""

import base64
import hashlib
import json
import secrets
from collections.abc import Iterable

from redis import Redis

SECRET_KEY = "caesura:secret"  # noqa: S105  the name of a key in Redis, not a secret
ID_BYTES = 16


def installation_secret(redis: Redis, configured: str = "") -> bytes:
    """The key of all ids: of `configured` where it is given, else 32 random bytes made once and kept in Redis."""
    if configured:
        return hashlib.blake2b(configured.encode()).digest()
    redis.set(SECRET_KEY, secrets.token_bytes(32), nx=True)
    kept = redis.get(SECRET_KEY)
    assert isinstance(kept, bytes)  # noqa: S101  set above, or by another process before
    return kept


def animation_id(secret: bytes, owner: str, parts: Iterable[tuple[str, int, str]]) -> str:
    """The id of an uploaded file of parts (name, length in bytes, digest as hexadecimal text).

    The order of the parts does not count. A lone part's name does not either: a raw body is the same file as
    a multipart form of one.
    """
    described = sorted([name, length, digest] for name, length, digest in parts)
    if len(described) == 1:
        described[0][0] = ""
    return _digest(secret, "animation", owner, described)


def segmentation_id(secret: bytes, animation: str, canonical: str, algorithm: str) -> str:
    """The id of one way to cut an animation: `Parameters.canonical()` with names resolved, and `ALGORITHM`."""
    return _digest(secret, "segmentation", animation, canonical, algorithm)


def webhook_secret(secret: bytes, owner: str) -> bytes:
    """The key that webhooks of an owner are signed with: 32 bytes, made of the installation's secret."""
    text = json.dumps(["webhook", owner]).encode()
    return hashlib.blake2b(text, key=secret, digest_size=32).digest()


def heavy_digest(heavy: dict[str, object], algorithm: str) -> str:
    """Names an analysis among those of one animation: what `Parameters.heavy()` says, and the algorithm."""
    return _digest(b"", "analysis", json.dumps(heavy, sort_keys=True), algorithm)


def random_token() -> str:
    """A name that no other attempt has."""
    return secrets.token_hex(12)


def _digest(secret: bytes, *content: object) -> str:
    """26 characters of lower-case base32: 128 bits."""
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":")).encode()
    digest = hashlib.blake2b(text, key=secret, digest_size=ID_BYTES).digest()
    return base64.b32encode(digest).decode().rstrip("=").lower()
