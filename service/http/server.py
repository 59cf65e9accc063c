"""The HTTP server, which tells those who wait that it is about to stop, so that their answers end in order."""

import socket
import sys

import uvicorn
from fastapi import FastAPI

GOODBYE_SECONDS = 3  # for answers that are under way
PROTOCOL = "auto" if sys.platform == "win32" else "caesura.service.http.protocol:Protocol"  # Windows has no httptools


def configuration(app: FastAPI, host: str = "127.0.0.1", port: int = 0, proxies: str = "") -> uvicorn.Config:
    """How every web process of ours runs uvicorn; `proxies` are believed, nobody else."""
    return uvicorn.Config(
        app,
        host,
        port,
        http=PROTOCOL,
        ws="none",
        proxy_headers=bool(proxies),
        forwarded_allow_ips=proxies,
        timeout_graceful_shutdown=GOODBYE_SECONDS,
        access_log=False,  # service/request_log.py says more
        log_config=None,  # worker/logs.py says how
        server_header=False,
    )


class Server(uvicorn.Server):
    """uvicorn, but for waits and event streams: they end when the process is told to stop, not when it is killed."""

    def __init__(self, app: FastAPI, host: str = "127.0.0.1", port: int = 0, proxies: str = "") -> None:
        super().__init__(configuration(app, host, port, proxies))
        self._app = app

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Answer what waits, take nothing new, end."""
        self._app.state.backend.stop_waiting()
        await super().shutdown(sockets)
