"""`caesura serve`: everything on one machine."""

from typing import Any

import click
from pydantic import ValidationError

from caesura.client.errors import Unreachable
from caesura.core.errors import ParameterError
from caesura.service.commands.exit_codes import Command


@click.command(cls=Command, short_help="Run the service, its workers and Redis.")
@click.option("--host", help="Address to listen on.  [default: CAESURA_HOST, else 127.0.0.1]")
@click.option(
    "--port", type=click.IntRange(0, 65535), help="Port; 0: any free one.  [default: CAESURA_PORT, else 8000]"
)
def serve(**given: Any) -> None:
    """Run the service, its workers and, unless REDIS_URL names one, a Redis-compatible server.

    CAESURA_DATA_DIR is the one folder it writes to. Ctrl-C or SIGTERM ends it, and everything that it started.
    """
    from caesura.service.process.supervisor import run_supervisor as supervise
    from caesura.service.settings import ServiceSettings
    from caesura.worker import logs
    from caesura.worker.embedded_redis.data_folder import ServerUnavailable

    try:
        settings = ServiceSettings(**{name: value for name, value in given.items() if value is not None})
        logs.configure_logging(settings.log_format)
        supervise(settings)
    except ValidationError as refused:
        first = refused.errors()[0]
        setting = f"CAESURA_{'_'.join(map(str, first['loc'])).upper()}"
        raise ParameterError("invalid-setting", f"{setting}: {first['msg']}.") from None
    except ServerUnavailable as refused:
        raise Unreachable("redis-unavailable", str(refused)) from None
    except OSError as refused:
        raise Unreachable("not-started", f"The service cannot start here: {refused}.") from None
