"""A client without a key that never ends what it says, or never says it, costs neither memory nor a connection."""

import asyncio
import contextlib
import json
import socket
import sys
import threading
import time

import httpx
import numpy as np
import pytest
import uvicorn

from caesura.service.http.protocol import MOST_HEAD_BYTES, Protocol
from tests.service.conftest import npz

WHOLE = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
CHUNKED = b"POST /v1/animations HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n1\r\n{\r\n"


def connected(url):
    place = httpx.URL(url)
    return socket.create_connection((place.host, place.port), timeout=20)


def heard(client):
    """All that comes until the other side hangs up."""
    told = b""
    with contextlib.suppress(ConnectionResetError):
        while piece := client.recv(1 << 16):
            told += piece
    return told


@pytest.mark.parametrize("begins", [b"GET / HTTP/1.1\r\nX-Long: ", b"GET /", WHOLE + b"GET / HTTP/1.1\r\nX-Long: "])
def test_a_head_without_end_is_refused(idle, begins):
    """One long header or address: the connection ends before it takes memory, also behind a request that was right."""
    before = idle.status("VmHWM")
    with connected(idle.url) as client:
        client.sendall(begins)
        with contextlib.suppress(ConnectionError):
            for _ in range(100):
                client.sendall(b"a" * 1_000_000)
        told = heard(client)
    assert b"head-too-large" in told or not told
    assert idle.status("VmHWM") - before < 20_000_000
    assert idle.http.get("/healthz").status_code == 200


@pytest.mark.parametrize("trailer", [b"0\r\nX-Long: ", b"0\r\n" + b"X: y\r\n" * 9])
def test_what_follows_a_body_ends_too(idle, trailer):
    """Headers may stand behind the last chunk: nobody reads them, and they are as short."""
    with connected(idle.url) as client:
        client.sendall(CHUNKED + trailer)
        more = b"X: y\r\n" * 10_000 if b"y" in trailer else b"a" * 60_000
        with contextlib.suppress(ConnectionError):
            for _ in range(300):
                client.sendall(more)
            pytest.fail("all of it was taken")


def test_many_and_long_headers_are_read_up_to_there(idle):
    """A browser with all its cookies gets in."""
    headers = {f"X-{number}": "a" * 1000 for number in range(MOST_HEAD_BYTES // 1100)}
    assert idle.http.get("/healthz", headers=headers).status_code == 200
    with connected(idle.url) as client:
        client.sendall(b"GET / HTTP/1.1\r\nX-Long: " + b"a" * MOST_HEAD_BYTES)
        head, _, body = heard(client).partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 431 ")
    assert json.loads(body)["code"] == "head-too-large"


DROPPED = threading.Event()


async def wait_for_disconnect(receive):
    while (await receive())["type"] != "http.disconnect":
        pass


class Hurried(Protocol):
    """The same in less time."""

    head_seconds, body_seconds, write_seconds, look_seconds = 0.3, 0.3, 0.3, 0.1


@pytest.fixture(scope="module")
def hurried():
    """A server that reads a body and says how long it was; at /endless its answer has no end."""

    async def app(scope, receive, send):
        if scope.get("path") == "/endless":
            await send({"type": "http.response.start", "status": 200, "headers": []})
            gone = asyncio.ensure_future(wait_for_disconnect(receive))
            while not gone.done():
                await send({"type": "http.response.body", "body": bytes(1 << 17), "more_body": True})
                await asyncio.sleep(0)
            DROPPED.set()
        size, more = 0, scope["type"] == "http"
        while more:
            message = await receive()
            size, more = size + len(message.get("body", b"")), message.get("more_body", False)
        await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"1")]})
        await send({"type": "http.response.body", "body": b"%d" % (size % 10)})

    listening = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(uvicorn.Config(app, http=Hurried, lifespan="off", log_config=None))
    thread = threading.Thread(target=server.run, args=([listening],), daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{listening.getsockname()[1]}"
    server.should_exit = True
    thread.join(10)


@pytest.mark.parametrize("said", [b"", b"GET / HT", b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\nab"])
def test_a_client_that_falls_silent_is_left(hurried, said):
    """Before a head, within it, or within a body."""
    with connected(hurried) as client:
        client.sendall(said)
        assert heard(client) == b""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux drops such a client")
def test_a_client_that_takes_nothing_of_its_answer_is_dropped(hurried):
    """The server ends the connection, and so the answer."""
    with connected(hurried) as client:
        client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        client.sendall(b"GET /endless HTTP/1.1\r\nHost: x\r\n\r\n")
        assert DROPPED.wait(10)


def test_answers_that_nobody_reads_take_little_memory(idle):
    """Sixty downloads of 7 MB each, which stand still."""
    content = npz(vertices=np.zeros((60, 10_000, 3), np.float32), triangles=[[0, 1, 2]])
    animation = idle.http.post("/v1/animations", content=content).json()["id"]
    before = idle.status("VmRSS")
    with contextlib.ExitStack() as stack:
        for _ in range(60):
            client = stack.enter_context(connected(idle.url))
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            client.sendall(f"GET /v1/animations/{animation}/file HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        for _ in range(4):
            time.sleep(0.5)
            assert idle.http.get("/healthz").elapsed.total_seconds() < 1
        assert idle.status("VmRSS") - before < 60_000_000


def test_a_slow_body_that_goes_on_is_waited_for(hurried):
    """Longer in all than may pass between two pieces of it."""
    pause = threading.Event()

    def pieces():
        for _ in range(6):
            pause.wait(0.15)
            yield b"a"

    assert httpx.post(hurried, content=pieces()).text == "6"
