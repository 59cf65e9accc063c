"""The socket that the service listens on, its address, and whether it answers."""

import http.client
import socket

ANSWER_SECONDS = 1.0
BACKLOG = 512


def open_listening_socket(host: str, port: int) -> socket.socket:
    """A socket that takes connections, of which up to some hundreds wait until they are answered."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    return socket.create_server((host, port), family=family, backlog=BACKLOG)


def address_of_socket(listening: socket.socket) -> str:
    """Where a client of this machine finds it."""
    host, port = listening.getsockname()[:2]
    host = _reachable(host)
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def is_answering(listening: socket.socket) -> bool:
    """Whether the web process is up. To connect alone tells nothing: the socket is ours."""
    host, port = listening.getsockname()[:2]
    connection = http.client.HTTPConnection(_reachable(host), port, timeout=ANSWER_SECONDS)
    try:
        connection.request("GET", "/healthz")
        return connection.getresponse().status == http.HTTPStatus.OK
    except (OSError, http.client.HTTPException):
        return False
    finally:
        connection.close()


def _reachable(host: str) -> str:
    """An address to connect to, where the one listened on is any."""
    return {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)  # noqa: S104  not bound here
