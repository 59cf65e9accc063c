"""Records as their owner may see them: another's is not even read, and takes as long as none."""

from collections.abc import Sequence
from functools import lru_cache

import redis.asyncio
from pydantic_core import to_json

SCRIPT = """
local found = {}
for place, key in ipairs(KEYS) do
  local head = redis.call('GETRANGE', key, 0, 127 + #ARGV[place])
  found[place] = string.find(head, ARGV[place], 1, true) and redis.call('GET', key) or false
end
return found
"""
"""An owner stands in the first 128 bytes of a record, after ids alone; in the texts behind them, quotes are escaped."""


class OwnedReads:
    """GET of many records at once, each for somebody."""

    def __init__(self, client: redis.asyncio.Redis) -> None:
        self._script = client.register_script(SCRIPT)

    async def __call__(self, wanted: Sequence[tuple[str, str]]) -> list[bytes | None]:
        """The stored record of each (key, owner), or None where there is none, or another's."""
        found: list[bytes | None] = await self._script(
            [key for key, _ in wanted], [_mark(owner) for _, owner in wanted]
        )
        return found


@lru_cache(maxsize=64)
def _mark(owner: str) -> bytes:
    """What a record of this owner says."""
    return b'"owner":' + to_json(owner)
