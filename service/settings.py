"""What the keeper of the web process may set beside the worker's settings."""

from pydantic import Field

from worker.settings import WorkerSettings


class ServiceSettings(WorkerSettings):
    """Where the service listens, and how much it takes in."""

    host: str = Field("127.0.0.1", description="address to listen on")
    port: int = Field(8000, ge=0, le=65535, description="port to listen on; 0: any free one")
    max_upload_bytes: int = Field(2 * 2**30, gt=0, description="bytes of one upload")
