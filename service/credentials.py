"""API keys: 256 random bits, shown once. Kept is their SHA-256 alone, which nobody can turn round.

A key has a name for people, and an owner: a random id that several keys may share, so that a new key can take an
old one's place without losing sight of anything.
"""

import hashlib
import re
import secrets
import time
from typing import Self

import redis
from pydantic import BaseModel, ConfigDict

from core.errors import ParameterError
from worker import keys
from worker.records import names

PREFIX = "caesura_"  # what scanners for secrets in source code look for
KEY_BYTES = 32
OWNER_BYTES = 8

_NAME = re.compile(r"[A-Za-z0-9._@-]{1,64}")


class KeyRecord(BaseModel):
    """One key: its name, whose it is, its digest (SHA-256, hexadecimal), and when it was made (s since 1970)."""

    model_config = ConfigDict(frozen=True)

    name: str
    owner: str
    digest: str
    created: float = 0.0

    @classmethod
    def read(cls, stored: bytes | str | None) -> Self | None:
        """The record of a stored value; None where there is none."""
        return None if stored is None else cls.model_validate_json(stored)


def new_key(name: str, owner: str | None = None) -> tuple[str, KeyRecord]:
    """A key, and what is kept of it; of an owner of its own where none is given. Raises `ParameterError` for a name."""
    if not _NAME.fullmatch(name):
        detail = f"{name!r} is no name for a key: take up to 64 letters, digits, and . _ @ - of them."
        raise ParameterError("invalid-parameter", detail, parameter="name")
    key = PREFIX + secrets.token_urlsafe(KEY_BYTES)
    owner = secrets.token_hex(OWNER_BYTES) if owner is None else owner
    return key, KeyRecord(name=name, owner=owner, digest=digest_of(key), created=time.time())


def digest_of(key: str) -> str:
    """What is kept of a key. It is looked up by this, so how long that takes tells nothing about any key."""
    return hashlib.sha256(key.encode()).hexdigest()


class KeyRing:
    """The keys that Redis holds, for the one who keeps the installation."""

    def __init__(self, client: redis.Redis) -> None:
        self._redis = client

    def add(self, record: KeyRecord) -> None:
        """Keep a new key; raises `ParameterError` where its name is taken."""
        with self._redis.pipeline() as pipe:
            pipe.watch(keys.API_KEYS_KEY)
            if pipe.hexists(keys.API_KEYS_KEY, record.name):
                detail = f"There is a key {record.name!r} already. Revoke it first, or choose another name."
                raise ParameterError("name-taken", detail, parameter="name")
            pipe.multi()
            pipe.hset(keys.API_KEYS_KEY, record.name, record.digest)
            pipe.set(keys.api_key_key(record.digest), record.model_dump_json())
            pipe.execute()

    def all(self) -> list[KeyRecord]:
        """All keys, oldest first."""
        digests = names(self._redis.hvals(keys.API_KEYS_KEY))
        stored = self._redis.mget([keys.api_key_key(digest) for digest in digests]) if digests else []
        known = [record for record in map(KeyRecord.read, stored) if record is not None]
        return sorted(known, key=lambda record: record.created)

    def named(self, name: str) -> KeyRecord:
        """The key of this name; raises `ParameterError` where there is none."""
        for record in self.all():
            if record.name == name:
                return record
        raise ParameterError("no-such-key", f"There is no key {name!r}. `caesura keys list` shows them.")

    def revoke(self, name: str) -> None:
        """From now on the key opens nothing, and nobody who signed in with it is signed in."""
        record = self.named(name)
        with self._redis.pipeline() as pipe:
            pipe.delete(keys.api_key_key(record.digest))
            pipe.hdel(keys.API_KEYS_KEY, name)
            pipe.execute()
