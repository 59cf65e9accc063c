"""A connection to the very address that was checked.

A name is looked up once for each connection, all its addresses are checked, and the connection is made to one of
these: a name that leads elsewhere at the next look-up gains nothing. httpcore follows no redirect, uses no proxy and
reads no environment. TLS still checks the certificate for the name.
"""

import socket
from collections.abc import Iterable
from typing import Any

import anyio
import httpcore

from caesura.service.http.outgoing.address_policy import AddressPolicy, ForbiddenAddress

LOOK_UP_SECONDS = 5.0


class CheckedBackend(httpcore.AsyncNetworkBackend):
    """Connects for httpcore where the policy lets it."""

    def __init__(self, policy: AddressPolicy) -> None:
        self._policy = policy
        self._network = httpcore.AnyIOBackend()

    async def connect_tcp(
        self,
        host: str,
        port: int,
        timeout: float | None = None,  # noqa: ASYNC109  httpcore's own
        local_address: str | None = None,
        socket_options: Iterable[Any] | None = None,
    ) -> httpcore.AsyncNetworkStream:
        """Look the name up, check what it leads to, and connect to that."""
        last: Exception | None = None
        for address in await checked_addresses(self._policy, host, port):
            try:
                return await self._network.connect_tcp(address, port, timeout, local_address, socket_options)
            except (httpcore.ConnectError, httpcore.ConnectTimeout) as fault:
                last = fault
        raise last or httpcore.ConnectError("the name has no address")

    async def connect_unix_socket(self, path: str, *_: Any, **__: Any) -> httpcore.AsyncNetworkStream:
        """Never."""
        raise ForbiddenAddress("forbidden-address", f"{path} is no address on the web.")

    async def sleep(self, seconds: float) -> None:
        """As httpcore pauses."""
        await anyio.sleep(seconds)


async def checked_addresses(policy: AddressPolicy, host: str, port: int) -> list[str]:
    """What a name leads to; raises `ForbiddenAddress` where any of it is forbidden, `ConnectError` without any."""
    try:
        with anyio.fail_after(LOOK_UP_SECONDS):
            found = await anyio.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except (OSError, UnicodeError, TimeoutError) as fault:
        raise httpcore.ConnectError(f"{host} cannot be looked up") from fault
    addresses = list(dict.fromkeys(str(one[4][0]) for one in found))
    for address in addresses:
        policy.check(address, port)
    return addresses


def connection_pool(policy: AddressPolicy, most: int) -> httpcore.AsyncConnectionPool:
    """A pool of at most so many connections at once, each used for one request."""
    return httpcore.AsyncConnectionPool(
        ssl_context=httpcore.default_ssl_context(),
        max_connections=most,
        max_keepalive_connections=0,
        network_backend=CheckedBackend(policy),
    )
