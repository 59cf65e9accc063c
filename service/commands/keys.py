"""`caesura keys`: who may use the service."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from caesura.client.errors import Unreachable
from caesura.core.errors import ParameterError
from caesura.service.commands.exit_codes import Command

if TYPE_CHECKING:
    from caesura.service.api_keys.key_ring import KeyRing


@click.group(short_help="Make, list and revoke the keys of a service.")
def keys() -> None:
    """Make, list and revoke the keys of the service that REDIS_URL or CAESURA_DATA_DIR names.

    A key is shown once; only its SHA-256 is kept. Each key sees what was made with it, and nothing else.
    """


@keys.command(cls=Command)
@click.argument("name")
@click.option("--like", metavar="NAME", help="See what the key NAME sees, so that this one can take its place.")
@click.option("--local", is_flag=True, help="See what was made while no key was needed.")
@click.option(
    "--metrics", is_flag=True, help="For Prometheus: it opens /metrics, which no other key opens, and nothing else."
)
@click.option("--line", is_flag=True, help="Keep it nowhere: print the line for CAESURA_KEYS_FILE too.")
def add(name: str, like: str | None, local: bool, metrics: bool, line: bool) -> None:
    """Make a key called NAME, and show it."""
    from caesura.service.api_keys import key_file
    from caesura.service.api_keys.credentials import new_key

    if sum(map(bool, (like, local, metrics))) > 1:
        detail = "--like, --local and --metrics each say what the key sees. Give one of them."
        raise ParameterError("invalid-parameter", detail)
    if line:
        if like:
            raise ParameterError("invalid-parameter", "With --line, copy the owner from the other key's line.")
        key, record = new_key(name, metrics=metrics)
        click.echo(f"{key}\n{key_file.key_file_line(record)}")
        return
    with _open_key_ring() as ring:
        owner = "" if local else ring.named(like).owner if like else None
        key, record = new_key(name, owner, metrics=metrics)
        ring.add(record)
    click.echo(key)


@keys.command("list", cls=Command)
def list_() -> None:
    """Names, the day each was made, and which open /metrics alone."""
    with _open_key_ring() as ring:
        for record in ring.all():
            made = time.strftime("%Y-%m-%d", time.gmtime(record.created))
            click.echo(f"{record.name:<32} {made}{'  metrics' if record.metrics else ''}")


@keys.command(cls=Command)
@click.argument("name")
def revoke(name: str) -> None:
    """End the key NAME, and whatever is signed in with it. What was made with it stays, until its time is up."""
    with _open_key_ring() as ring:
        ring.revoke(name)


@contextmanager
def _open_key_ring() -> Iterator["KeyRing"]:
    """The keys of the service; raises `Unreachable` where its Redis does not answer."""
    from redis.exceptions import RedisError

    from caesura.service.api_keys.key_ring import KeyRing
    from caesura.service.settings import ServiceSettings
    from caesura.worker.records.connection import connect

    location = ServiceSettings().redis_location
    try:
        with connect(location) as client:
            yield KeyRing(client)
    except RedisError:
        detail = f"The service's Redis at {_without_password(location)} does not answer. Start the service first."
        raise Unreachable("redis-unavailable", detail) from None


def _without_password(location: str) -> str:
    """An address without the password in it."""
    return location.rpartition("@")[2] if "@" in location else location
