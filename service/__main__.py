"""`python -m caesura.service`: the web process alone. `caesura serve` starts Redis and workers beside it."""

from caesura.service.app import create_app
from caesura.service.http.server import Server
from caesura.service.settings import ServiceSettings
from caesura.worker import logs


def main() -> None:
    """Serve until told to stop."""
    settings = ServiceSettings()
    logs.configure_logging(settings.log_format)
    Server(create_app(settings), settings.host, settings.port, settings.proxies).run()


if __name__ == "__main__":
    main()
