"""A web process that is told to stop answers those who wait, and ends at once."""

import http.client
import json
import os
import signal
import time

from tests.service.conftest import half_upload, serve


def test_waits_and_streams_end_in_order(idle, take, checkout, tmp_path):
    """The wait is answered with what there is, the stream ends whole; neither holds the process up."""
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        identifier = other.http.post("/v1/segmentations", content=take(501)).json()["id"]
        address, host = f"/v1/segmentations/{identifier}", other.url.removeprefix("http://")
        waiting, listening = (http.client.HTTPConnection(host, timeout=40) for _ in range(2))
        waiting.request("GET", address, headers={"Prefer": "wait=30"})
        listening.request("GET", f"{address}/events")
        stream = listening.getresponse()
        heard = stream.readline()
        began = time.monotonic()
    assert time.monotonic() - began < 2.5
    assert json.loads(waiting.getresponse().read())["status"] == "queued"
    heard += stream.read()
    assert heard.endswith(b"\n\n")
    for connection in (waiting, listening):
        connection.close()


def test_an_upload_that_the_end_cuts_short_is_told_to_come_again(idle, checkout, tmp_path):
    """503 with Retry-After for what still comes, neither 500 nor a connection that breaks; nothing is kept."""
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        with half_upload(other) as client:
            os.kill(other.pid, signal.SIGTERM)
            time.sleep(0.3)
            client.sendall(bytes(500_000))
            answer = http.client.HTTPResponse(client)
            answer.begin()
            assert (answer.status, json.load(answer)["code"]) == (503, "not-ready")
            assert int(answer.headers["Retry-After"]) >= 1
        assert not other.spooled()
