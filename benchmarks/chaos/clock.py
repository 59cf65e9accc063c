"""A clock that is set wrong while takes are segmented: by hours, when jobs would end, or by weeks, when files would.

Only the service's own processes have it: see `jumping_clock`.
"""

import os
import random
from contextlib import suppress
from pathlib import Path

from redis import Redis
from redis.exceptions import RedisError

from caesura.worker.records import redis_keys

HOUR = 3600
JUMPS = (2 * HOUR, 40 * 24 * HOUR, -40 * 24 * HOUR, 0)
"""Seconds by which it is wrong from then on; 0 puts it right."""


class JumpingClock:
    """The clock of one installation; right, until it is set. Its file lies beside the installation's folder."""

    def __init__(self, folder: Path) -> None:
        self._file = folder.with_name(f"{folder.name}.clock")
        self._set(0)

    @property
    def environment(self) -> dict[str, str]:
        """What gives a Python process this clock."""
        path = [str(Path(__file__).parent / "jumping_clock"), os.environ.get("PYTHONPATH", "")]
        return {"PYTHONPATH": os.pathsep.join(filter(None, path)), "JUMPING_CLOCK": str(self._file)}

    def jump(self, redis: Redis, chance: random.Random) -> None:
        """Set it to another time, and have the hourly sweep come at once."""
        self._set(chance.choice(JUMPS))
        with suppress(RedisError):
            redis.delete(redis_keys.LAST_SWEEP_KEY)

    def _set(self, seconds: int) -> None:
        new = self._file.with_suffix(".new")
        new.write_text(str(seconds))
        new.replace(self._file)
