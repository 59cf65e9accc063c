"""The API keys in Redis, for the operator."""

import redis

from caesura.core.errors import ParameterError
from caesura.service.api_keys.credentials import KeyRecord
from caesura.worker.records import redis_keys
from caesura.worker.records.connection import decode_names


class KeyRing:
    """Makes, lists and revokes."""

    def __init__(self, client: redis.Redis) -> None:
        self._redis = client

    def add(self, record: KeyRecord) -> None:
        """Keep a new key; raises `ParameterError` where its name is taken."""
        with self._redis.pipeline() as pipe:
            pipe.watch(redis_keys.API_KEYS_KEY)
            if pipe.hexists(redis_keys.API_KEYS_KEY, record.name):
                detail = f"There is a key {record.name!r} already. Revoke it first, or choose another name."
                raise ParameterError("name-taken", detail, parameter="name")
            pipe.multi()
            pipe.hset(redis_keys.API_KEYS_KEY, record.name, record.digest)
            pipe.set(redis_keys.api_key_key(record.digest), record.model_dump_json())
            pipe.execute()

    def all(self) -> list[KeyRecord]:
        """All keys, oldest first."""
        digests = decode_names(self._redis.hvals(redis_keys.API_KEYS_KEY))
        stored = self._redis.mget([redis_keys.api_key_key(digest) for digest in digests]) if digests else []
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
            pipe.delete(redis_keys.api_key_key(record.digest))
            pipe.hdel(redis_keys.API_KEYS_KEY, name)
            pipe.set(redis_keys.DELETED_KEY, b"1")
            pipe.execute()
