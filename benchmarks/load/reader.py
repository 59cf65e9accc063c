"""A client process that reads one address again and again: `… reader HOST PORT PATH SECONDS [PAUSE]`.

It writes the milliseconds of every answer as JSON when the time is over, or at SIGTERM. One connection, kept alive, and
next to no work of its own: what is measured is the server.
"""

import json
import signal
import socket
import sys
import time

ENOUGH = 1 << 16


def main() -> None:
    """Read until the time is over."""
    host, port, path, seconds, *pause = sys.argv[1:]
    over: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: over.append(number))
    request = f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nAccept: application/json\r\n\r\n".encode()
    took = []
    with socket.create_connection((host, int(port))) as connection:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        end = time.perf_counter() + float(seconds)
        while not over and (since := time.perf_counter()) < end:
            connection.sendall(request)
            read_answer(connection)
            took.append((time.perf_counter() - since) * 1000)
            time.sleep(float(pause[0]) if pause else 0)
    json.dump(took, sys.stdout)


def read_answer(connection: socket.socket) -> None:
    """One whole answer of status 200; anything else ends the measurement."""
    received = connection.recv(ENOUGH)
    while b"\r\n\r\n" not in received:
        received += connection.recv(ENOUGH)
    head, _, body = received.partition(b"\r\n\r\n")
    if not head.startswith(b"HTTP/1.1 200"):
        raise SystemExit(head.decode())
    length = int(head.lower().split(b"content-length:")[1].split(b"\r\n")[0])
    missing = length - len(body)
    while missing > 0:
        missing -= len(connection.recv(ENOUGH))


if __name__ == "__main__":
    main()
