"""The web process that `serve` starts: it listens on a socket it was given, so no connection is lost if it restarts."""

import argparse
import gc
import socket

from caesura.service.app import create_app
from caesura.service.http.server import Server
from caesura.service.settings import ServiceSettings
from caesura.worker import logs


def main() -> None:
    """Serve until SIGTERM."""
    parser = argparse.ArgumentParser(prog="python -m caesura.service.web")
    parser.add_argument("--socket", type=int, required=True, help="number of the inherited, bound socket")
    listening = socket.socket(fileno=parser.parse_args().socket)
    settings = ServiceSettings()
    logs.configure_logging(settings.log_format)
    server = Server(create_app(settings), proxies=settings.proxies)
    # What is loaded now stays. Looking through it for garbage would keep every answer waiting for 40 ms, now and again.
    gc.collect()
    gc.freeze()
    server.run(sockets=[listening])


if __name__ == "__main__":
    main()
