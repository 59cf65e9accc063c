"""A web process that is told to stop answers those who wait, and ends at once."""

import http.client
import json
import os
import signal
import socket
import threading
import time

import httpx

from tests.service.conftest import serve


def test_waits_and_streams_end_in_order(idle, take, checkout, tmp_path):
    """The wait is answered with what there is, the stream ends whole; neither holds the process up."""
    heard = {}
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        identifier = other.http.post("/v1/segmentations", content=take(501)).json()["id"]
        address = f"{other.url}/v1/segmentations/{identifier}"

        def wait():
            heard["wait"] = httpx.get(address, headers={"Prefer": "wait=30"}, timeout=40).json()["status"]

        def listen():
            heard["stream"] = httpx.get(f"{address}/events", timeout=40).text

        threads = [threading.Thread(target=wait), threading.Thread(target=listen)]
        for thread in threads:
            thread.start()
        time.sleep(0.5)
        began = time.monotonic()
    assert time.monotonic() - began < 2.5
    for thread in threads:
        thread.join(5)
    assert heard["wait"] == "queued"
    assert heard["stream"].endswith("\n\n")


def test_an_upload_that_the_end_cuts_short_is_told_to_come_again(idle, checkout, tmp_path):
    """503 with Retry-After for what still comes, neither 500 nor a connection that breaks; nothing is kept."""
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        host, port = other.url.removeprefix("http://").split(":")
        with socket.create_connection((host, int(port)), timeout=20) as client:
            client.sendall(b"POST /v1/animations HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5000000\r\n\r\nglTF")
            client.sendall(bytes(2_000_000))
            deadline = time.monotonic() + 20
            while not other.spooled():
                assert time.monotonic() < deadline
                time.sleep(0.02)
            os.kill(other.pid, signal.SIGTERM)
            time.sleep(0.3)
            client.sendall(bytes(500_000))
            answer = http.client.HTTPResponse(client)
            answer.begin()
            assert (answer.status, json.load(answer)["code"]) == (503, "not-ready")
            assert int(answer.headers["Retry-After"]) >= 1
        assert not other.spooled()
