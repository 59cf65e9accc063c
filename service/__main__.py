"""`python -m service`: the web process alone. `caesura serve` starts Redis and workers beside it."""

import uvicorn

from service.app import create_app
from service.settings import ServiceSettings

SHUTDOWN_SECONDS = 5  # event streams are ended after that


def main() -> None:
    """Serve until told to stop."""
    settings = ServiceSettings()
    uvicorn.run(
        create_app(settings),
        host=settings.host,
        port=settings.port,
        timeout_graceful_shutdown=SHUTDOWN_SECONDS,
        server_header=False,
    )


if __name__ == "__main__":
    main()
