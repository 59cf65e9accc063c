"""What the keeper of an installation may set: environment variables that begin with CAESURA_, read once per process."""

import os
from pathlib import Path
from typing import Literal
from urllib.parse import quote

from pydantic import AliasChoices, Field, FilePath
from pydantic_settings import BaseSettings, SettingsConfigDict

from caesura.core.limits import Limits


def _data_home() -> Path:
    return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share") / "caesura"


class WorkerSettings(Limits, BaseSettings):
    """Where the queue and the files are, and how much one job may use; the limits of a model are settings too."""

    model_config = SettingsConfigDict(frozen=True, extra="ignore", env_prefix="CAESURA_", populate_by_name=True)

    data_dir: Path = Field(default_factory=_data_home, description="folder for files, scratch and the embedded Redis")
    redis_url: str = Field(
        "",
        validation_alias=AliasChoices("REDIS_URL", "CAESURA_REDIS_URL"),
        description="the Redis to use; empty: the embedded server of this machine",
    )
    redis_server_bin: str = Field("", description="program of the embedded Redis; empty: the bundled one, else PATH's")
    store_url: str = Field(
        "", description="object store, such as s3://bucket/prefix; empty: a folder in the data folder"
    )
    secret: str = Field("", description="key of all ids; empty: one is made and kept in Redis")
    threads: int = Field(0, ge=0, description="threads of one job; 0: what affinity and cgroup quota give")
    job_seconds: int = Field(3600, gt=0, description="seconds one job may take")
    job_memory_bytes: int = Field(2 * 2**30, gt=0, description="bytes one job may use beside its mapped files")
    max_queued: int = Field(10_000, ge=0, description="jobs that may wait; more are refused. 0: any number")
    attempts: int = Field(3, ge=1, description="attempts of a job whose worker is lost")
    stop_seconds: float = Field(5.0, ge=0, description="seconds a running job gets to end before it is handed back")
    keep_upload_days: float = Field(7.0, gt=0, description="days an upload and its analyses stay after their last use")
    keep_result_days: float = Field(30.0, gt=0, description="days a result stays")

    font: FilePath | Literal[""] = Field(
        "", description="a .ttf or .otf file for names in PNG plots; empty: plain letters alone"
    )
    log_format: Literal["text", "json"] = Field("text", description="log lines: `text` for people, `json` for machines")
    min_free_bytes: int = Field(512 * 2**20, ge=0, description="bytes that stay free on the disk; below, no new work")

    @property
    def limits(self) -> Limits:
        """The limits alone, as core takes them."""
        return Limits(**self.model_dump(include=set(Limits.model_fields)))

    @property
    def scratch_dir(self) -> Path:
        """Where uploads spool and unlinked scratch files live: beside the store, so that a file can be moved in."""
        return self.data_dir / "scratch"

    @property
    def redis_dir(self) -> Path:
        """What the embedded server keeps."""
        return self.data_dir / "redis"

    @property
    def redis_location(self) -> str:
        """The URL to connect to: the one given, else the socket of this data folder's embedded server."""
        return self.redis_url or f"unix://{quote(str(self.redis_dir / 'redis.sock'))}"

    @property
    def store_location(self) -> str:
        """The store's URL or folder, as `Blobs.open` takes it."""
        return self.store_url or str(self.data_dir / "blobs")

    def environment(self) -> dict[str, str]:
        """These settings as a child process reads them."""
        values = self.model_dump(mode="json", exclude={"redis_url"})
        settings = {f"CAESURA_{name.upper()}": str(value) for name, value in values.items() if value is not None}
        return {**settings, "REDIS_URL": self.redis_location}
