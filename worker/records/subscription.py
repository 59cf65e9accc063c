"""What is told on Redis's channels, heard on one connection for everyone in this process who waits.

A connection for each would be made anew for every wait, and there would be as many as event streams are open.
"""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress

import redis.asyncio
from redis.asyncio.client import PubSub
from redis.exceptions import RedisError

from caesura.worker.records import redis_keys

LISTEN_SECONDS = 3.0
NOWHERE = redis_keys.channel("")
"""Always listened to, so that the connection is never one for other calls; nobody speaks there."""

Messages = frozenset[bytes]


class Subscription:
    """One who waits on a channel. It is woken by every word but those that it is deaf to."""

    def __init__(self, deaf: Messages) -> None:
        self._deaf = deaf
        self._woken = asyncio.Event()

    def hear(self, word: bytes) -> None:
        """What was said."""
        if word not in self._deaf:
            self._woken.set()

    async def woken(self, seconds: float) -> None:
        """Until something is said, or was since the last time; at most so long."""
        with suppress(TimeoutError):
            async with asyncio.timeout(seconds):
                await self._woken.wait()
        self._woken.clear()


class ChannelListener:
    """The ears of one process. Where the connection breaks all are woken, and whoever asks next makes a new one."""

    def __init__(self, client: redis.asyncio.Redis) -> None:
        self._redis = client
        self._ears: dict[str, set[Subscription]] = {}
        self._confirmed: dict[str, asyncio.Event] = {}
        self._lock = asyncio.Lock()
        self._pubsub: PubSub | None = None
        self._reading: asyncio.Task[None] | None = None

    @asynccontextmanager
    async def hearing(self, channel: str, deaf: Messages = frozenset()) -> AsyncIterator[Subscription]:
        """An ear on a channel, once the server has said that it is listened to."""
        ear = Subscription(deaf)
        self._ears.setdefault(channel, set()).add(ear)
        try:
            await self.attend(channel)
            yield ear
        finally:
            self._ears[channel].discard(ear)
            if not self._ears[channel]:
                del self._ears[channel]  # the channel itself is left by the one who reads: this may be a cancel

    async def attend(self, channel: str) -> None:
        """Listen to a channel, where a broken connection has ended that. Raises what redis-py raises."""
        if channel not in self._confirmed:
            async with self._lock:
                if self._pubsub is None:
                    await self._open()
                if channel not in self._confirmed and self._pubsub is not None:
                    self._confirmed[channel] = asyncio.Event()
                    await self._pubsub.subscribe(channel)
        confirmed = self._confirmed.get(channel)
        if confirmed is not None:
            with suppress(TimeoutError):
                async with asyncio.timeout(LISTEN_SECONDS):
                    await confirmed.wait()

    async def close(self) -> None:
        """Hear nothing more."""
        if self._reading is not None:
            self._reading.cancel()
            with suppress(asyncio.CancelledError):
                await self._reading
        if self._pubsub is not None:
            await self._pubsub.aclose()

    async def _open(self) -> None:
        pubsub = self._redis.pubsub()
        await pubsub.subscribe(NOWHERE)
        self._pubsub = pubsub
        self._reading = asyncio.create_task(self._read(pubsub))

    async def _read(self, pubsub: PubSub) -> None:
        try:
            while True:
                message = await pubsub.get_message(timeout=LISTEN_SECONDS)
                if message is not None:
                    self._pass_on(message["type"], bytes(message["channel"]).decode(), message["data"])
                if self._confirmed.keys() - self._ears.keys():
                    await self._leave(pubsub)
        except (RedisError, OSError):
            self._pubsub = None
            self._confirmed.clear()
            for channel in self._ears:
                self._wake(channel, b"")
            with suppress(RedisError, OSError):
                await pubsub.aclose()

    def _pass_on(self, kind: str, channel: str, word: bytes) -> None:
        if kind == "subscribe" and channel in self._confirmed:
            self._confirmed[channel].set()
        elif kind == "message":
            self._wake(channel, word)

    def _wake(self, channel: str, word: bytes) -> None:
        for ear in self._ears.get(channel, ()):
            ear.hear(word)

    async def _leave(self, pubsub: PubSub) -> None:
        """Stop listening where nobody waits any more."""
        async with self._lock:
            left = [c for c, confirmed in self._confirmed.items() if confirmed.is_set() and c not in self._ears]
            for channel in left:
                del self._confirmed[channel]
            if left:
                await pubsub.unsubscribe(*left)
