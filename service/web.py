"""The web process that `serve` starts: it listens on a socket it was given, so no connection is lost if it restarts."""

import argparse
import socket

import uvicorn

from service.app import create_app
from service.settings import ServiceSettings

GOODBYE_SECONDS = 3  # for answers that are under way; event streams end


def main() -> None:
    """Serve until SIGTERM."""
    parser = argparse.ArgumentParser(prog="python -m service.web")
    parser.add_argument("--socket", type=int, required=True, help="number of the inherited, bound socket")
    listening = socket.socket(fileno=parser.parse_args().socket)
    app = create_app(ServiceSettings())
    config = uvicorn.Config(app, timeout_graceful_shutdown=GOODBYE_SECONDS, access_log=False, server_header=False)
    uvicorn.Server(config).run(sockets=[listening])


if __name__ == "__main__":
    main()
