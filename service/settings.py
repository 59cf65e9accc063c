"""The settings of the web process, beside the worker's."""

from ipaddress import ip_address, ip_network
from pathlib import Path
from typing import Literal
from urllib.parse import urlsplit

from pydantic import Field, field_validator

from caesura.worker.settings import WorkerSettings

REQUESTS_A_MINUTE = 1200
"""Where keys are needed and nothing else is said: twenty a second, more than the page asks for while it plays."""


class ServiceSettings(WorkerSettings):
    """Where the service listens, how much it takes in, and from whom."""

    host: str = Field("127.0.0.1", description="address to listen on")
    port: int = Field(8000, ge=0, le=65535, description="port to listen on; 0: any free one")
    max_upload_bytes: int = Field(2 * 2**30, gt=0, description="bytes of one upload")
    access: Literal["auto", "keys", "open"] = Field(
        "auto", description="`keys`: only with a key; `open`: anybody; `auto`: open on loopback, keys elsewhere"
    )
    keys_file: Path | None = Field(None, description="file of further keys, such as a mounted secret")
    public_hosts: str = Field("", description="names that browsers reach the service by, with commas between")
    cors_origins: str = Field(
        "", description="origins of other sites whose pages may use the API with a key, with commas between"
    )
    private_networks: str = Field(
        "", description="private addresses or networks that webhooks and uploads by URL may reach, with commas between"
    )
    upload_hosts: str = Field(
        "",
        description="hosts that uploads by URL may come from, with commas between; `*.example.com`: all below; "
        "empty: no such uploads",
    )
    proxies: str = Field(
        "",
        description="addresses or networks of proxies whose `X-Forwarded-For` is believed, with commas between",
    )
    max_collection_takes: int = Field(1000, gt=0, description="takes of one collection")
    max_collection_seconds: float = Field(20 * 3600.0, gt=0, description="seconds of all takes of one collection")
    requests_a_minute: int = Field(
        -1, ge=-1, description="from one key and address; 0: no limit; -1: 1,200 where keys are needed, else no limit"
    )

    @field_validator("cors_origins")
    @classmethod
    def _check_origins(cls, given: str) -> str:
        for origin in _split(given):
            parts = urlsplit(origin)
            if (
                parts.scheme not in {"http", "https"}
                or not parts.hostname
                or origin != f"{parts.scheme}://{parts.netloc}"
            ):
                raise ValueError(f"{origin!r} is no origin, such as https://studio.example; `*` is none either")
        return given

    @field_validator("private_networks")
    @classmethod
    def _check_networks(cls, given: str) -> str:
        for network in _split(given):
            ip_network(network)
        return given

    @property
    def page_origins(self) -> tuple[str, ...]:
        """The origins of `cors_origins`."""
        return _split(self.cors_origins)

    @property
    def keys_needed(self) -> bool:
        """Whether a request must say whose it is."""
        return self.access == "keys" or (self.access == "auto" and not _is_loopback(self.host))

    @property
    def rate_limit(self) -> int:
        """Requests a minute; 0 where there is no limit."""
        if self.requests_a_minute >= 0:
            return self.requests_a_minute
        return REQUESTS_A_MINUTE if self.keys_needed else 0


def _split(listed: str) -> tuple[str, ...]:
    return tuple(one.strip() for one in listed.split(",") if one.strip())


def _is_loopback(host: str) -> bool:
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
