"""The version of all that is stored: what Redis holds of ours, and the blobs that it points to.

| layout | what changed |
|---|---|
| 1 | the first: keys as in `caesura.worker.records.redis_keys`, records as in `caesura.worker.records.record_types` |

New fields of records with a default, and new keys, are no new layout: an older service ignores them. A layout is for
what an older service would read wrongly. The first service of a new version raises the number.
"""

from redis import Redis

from caesura.worker.embedded_redis.data_folder import ServerUnavailable
from caesura.worker.records import redis_keys

LAYOUT = 1


class LayoutTooNew(ServerUnavailable):
    """What is stored was written by a later version; the message says what to do."""


def check_layout(client: Redis) -> None:
    """Note our layout where there is none, or an older one; raises `LayoutTooNew`."""
    client.set(redis_keys.LAYOUT_KEY, str(LAYOUT), nx=True)
    stored = client.get(redis_keys.LAYOUT_KEY)
    kept = int(stored) if isinstance(stored, bytes) else LAYOUT
    if kept > LAYOUT:
        raise LayoutTooNew(
            f"What is stored here has layout {kept}, and this version of Caesura knows {LAYOUT} at most. Use the "
            "version that wrote it, or give this one a data folder and a Redis of its own: CAESURA_DATA_DIR, REDIS_URL."
        )
    if kept < LAYOUT:
        client.set(redis_keys.LAYOUT_KEY, str(LAYOUT))
