"""What the keeper of the web process may set beside the worker's settings."""

from ipaddress import ip_address
from pathlib import Path
from typing import Literal

from pydantic import Field

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
    proxies: str = Field(
        "",
        description="addresses or networks of proxies whose `X-Forwarded-For` is believed, with commas between",
    )
    requests_a_minute: int = Field(
        -1, ge=-1, description="from one key and address; 0: no limit; -1: 1,200 where keys are needed, else no limit"
    )

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


def _is_loopback(host: str) -> bool:
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
