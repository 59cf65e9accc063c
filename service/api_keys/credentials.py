"""API keys: 256 random bits, shown once. Kept is their SHA-256 alone, which nobody can turn round.

A key has a name for people, and an owner: a random id that several keys may share, so that a new key can take an
old one's place without losing sight of anything.
"""

import hashlib
import re
import secrets
import time
from typing import Self

from pydantic import BaseModel, ConfigDict

from caesura.core.errors import ParameterError

PREFIX = "caesura_"  # what scanners for secrets in source code look for
KEY_BYTES = 32
OWNER_BYTES = 8

_NAME = re.compile(r"[A-Za-z0-9._@-]{1,64}")


class KeyRecord(BaseModel):
    """One key: its name, whose it is, its digest (SHA-256, hexadecimal), and when it was made (s since 1970).

    `metrics`: it opens /metrics and nothing else, which no other key opens: there are everybody's sums.
    """

    model_config = ConfigDict(frozen=True)

    name: str
    owner: str
    digest: str
    created: float = 0.0
    metrics: bool = False

    @classmethod
    def read(cls, stored: bytes | str | None) -> Self | None:
        """The record of a stored value; None where there is none."""
        return None if stored is None else cls.model_validate_json(stored)


def new_key(name: str, owner: str | None = None, *, metrics: bool = False) -> tuple[str, KeyRecord]:
    """A key, and what is kept of it; of an owner of its own where none is given. Raises `ParameterError` for a name."""
    if not _NAME.fullmatch(name):
        detail = f"{name!r} is no name for a key: take up to 64 letters, digits, and . _ @ - of them."
        raise ParameterError("invalid-parameter", detail, parameter="name")
    key = PREFIX + secrets.token_urlsafe(KEY_BYTES)
    owner = secrets.token_hex(OWNER_BYTES) if owner is None else owner
    return key, KeyRecord(name=name, owner=owner, digest=digest_of(key), created=time.time(), metrics=metrics)


def digest_of(key: str) -> str:
    """What is kept of a key. It is looked up by this, so how long that takes tells nothing about any key."""
    return hashlib.sha256(key.encode()).hexdigest()
