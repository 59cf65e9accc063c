"""Whether the clock may say what is old: it must have gone evenly, from look to look, for a day.

A clock that jumps ahead makes everything old at once, and what is deleted is gone; to wait costs a day. A machine that
was off looks the same, so a gap is taken for a jump only where it is long beside the time that things are kept.
"""

import logging
from datetime import UTC, datetime

from redis import Redis

from caesura.worker.records import redis_keys

log = logging.getLogger(__name__)

EVEN_SECONDS = 24 * 3600.0
SKEW_SECONDS = 300.0
"""The clocks of two machines may differ by so much."""


def gone_evenly(client: Redis, longest_gap: float, now: float) -> bool:
    """Note the time `now`, and answer whether there was no gap above `longest_gap` s, and no way back, for a day.

    The first look is compared with the last use of anything. Where the answer is no, the log says why and until when.
    """
    kept = client.hgetall(redis_keys.CLOCK_KEY)
    newest = client.zrange(redis_keys.LAST_USED_KEY, -1, -1, withscores=True)
    last = float(kept[b"last"]) if kept else float(newest[0][1]) if newest else now
    since = float(kept.get(b"since", 0.0))
    if not -SKEW_SECONDS <= now - last <= longest_gap:
        since = now
    client.hset(redis_keys.CLOCK_KEY, mapping={"last": repr(now), "since": repr(since)})
    if now - since >= EVEN_SECONDS:
        return True
    until = datetime.fromtimestamp(since + EVEN_SECONDS, UTC)
    log.warning(
        "Nothing is deleted for its age until %s: the clock jumped, or this service was off for long (%.1f days since "
        "the last look). Check the clock of this machine.",
        f"{until:%Y-%m-%d %H:%M} UTC",
        (now - last) / EVEN_SECONDS,
    )
    return False
