"""Which addresses of the network the service may connect to for a client: public ones, and those the operator allows.

Whoever lets a server fetch what he names would otherwise reach what the server reaches: its own ports, its
neighbours, and the metadata of its cloud (169.254.169.254).
"""

from collections.abc import Sequence
from ipaddress import IPv4Address, IPv4Network, IPv6Address, IPv6Network, ip_address, ip_network

from caesura.service.problems.problem_response import RequestProblem

Network = IPv4Network | IPv6Network

NAT64 = ip_network("64:ff9b::/96")
"""IPv6 addresses that lead to the IPv4 address of their last 32 bits (RFC 6052)."""

TUNNELS = (ip_network("2002::/16"), ip_network("2001::/32"), ip_network("64:ff9b:1::/48"))
"""6to4, Teredo, and NAT64 of a local choice: where they lead is for their relays to say."""

SYSTEM_PORTS = 1024
WEB_PORTS = frozenset({80, 443})


class ForbiddenAddress(RequestProblem):
    """The service does not connect to this address for anybody."""


class AddressPolicy:
    """Public addresses, and the networks of `allowed`, which the operator lists with commas between."""

    def __init__(self, allowed: str = "") -> None:
        self._allowed = parse_networks(allowed)

    def check(self, address: str, port: int) -> None:
        """Raises `ForbiddenAddress`, which names no address: a client is not to learn where a name leads here."""
        found = _effective(ip_address(address.partition("%")[0]))
        if any(found.version == network.version and found in network for network in self._allowed):
            return
        if not found.is_global or found.is_multicast or found.is_reserved or _is_tunnel(found):
            raise ForbiddenAddress(
                "forbidden-address",
                "The address leads to a network that this service does not connect to. Use a public one, or ask the "
                "operator to allow the network in CAESURA_PRIVATE_NETWORKS.",
                setting="CAESURA_PRIVATE_NETWORKS",
            )
        if port < SYSTEM_PORTS and port not in WEB_PORTS:
            raise ForbiddenAddress("forbidden-address", f"The service does not connect to port {port}. Use 80 or 443.")


def parse_networks(listed: str) -> Sequence[Network]:
    """Addresses and networks with commas between; raises `ValueError`."""
    return tuple(ip_network(one.strip()) for one in listed.split(",") if one.strip())


def _effective(address: IPv4Address | IPv6Address) -> IPv4Address | IPv6Address:
    """The address that a connection to this one reaches: IPv4 may be written as IPv6."""
    if isinstance(address, IPv6Address):
        if address.ipv4_mapped is not None:
            return address.ipv4_mapped
        compatible = 1 < int(address) < 2**32  # IPv4 as it was once written as IPv6
        if address in NAT64 or compatible:
            return IPv4Address(int(address) & 0xFFFFFFFF)
    return address


def _is_tunnel(address: IPv4Address | IPv6Address) -> bool:
    return any(address.version == network.version and address in network for network in TUNNELS)
