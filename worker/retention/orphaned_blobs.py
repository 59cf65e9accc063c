"""Deletes blobs that no record points to: their process was killed before it wrote or after it deleted one.

A blob is young for a while before it is pointed to, so it is forgotten only if it was in doubt at an earlier look too,
long enough ago. Both times are told by the one who looks; no two clocks are compared.
"""

import time
from collections.abc import Iterator

from caesura.worker.records import Records, redis_keys
from caesura.worker.records.connection import decode_names
from caesura.worker.retention.deletion import blobs_of_animation, blobs_of_collection
from caesura.worker.store.blobs import Blobs


def delete_orphaned_blobs(records: Records, blobs: Blobs, doubt_seconds: float) -> dict[str, int]:
    """Delete what was in doubt for `doubt_seconds`, and answer how many bytes each kind of blob takes now."""
    now = time.time()
    stored = dict(blobs.all())  # before the pointers: what is kept meanwhile is not even seen
    pointed = set(_pointers(records))
    kept = records.redis.hgetall(redis_keys.ORPHAN_CANDIDATES_KEY)
    doubted = {key: float(since) for key, since in zip(decode_names(kept), kept.values(), strict=True)}
    doubtful = {key: min(doubted.get(key, now), now) for key in stored if key not in pointed}
    orphans = [key for key, since in doubtful.items() if key in doubted and since <= now - doubt_seconds]
    for key in orphans:
        blobs.delete(key)
    sizes: dict[str, int] = {}
    for key in stored.keys() - set(orphans):
        kind = key.partition("/")[0]
        sizes[kind] = sizes.get(kind, 0) + stored[key]
    _store_doubtful(records, {key: since for key, since in doubtful.items() if key not in orphans}, sizes)
    return sizes


def _pointers(records: Records) -> Iterator[str]:
    """The keys of all blobs that some record names."""
    for identifier in records.animations.uses():
        animation = records.animations.one(identifier)
        if animation is not None:
            yield from blobs_of_animation(records, animation)
    for identifier in records.collections.all():
        yield from blobs_of_collection(records, identifier)


def _store_doubtful(records: Records, doubtful: dict[str, float], sizes: dict[str, int]) -> None:
    """Keep what is in doubt for the next look, and the sizes for whoever asks."""
    with records.redis.pipeline() as pipe:
        pipe.delete(redis_keys.ORPHAN_CANDIDATES_KEY, redis_keys.STORE_KEY)
        if doubtful:
            pipe.hset(redis_keys.ORPHAN_CANDIDATES_KEY, mapping={key: repr(since) for key, since in doubtful.items()})
        if sizes:
            pipe.hset(redis_keys.STORE_KEY, mapping={kind: str(size) for kind, size in sizes.items()})
        pipe.execute()
