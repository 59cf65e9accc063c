"""A web process that is told to stop answers those who wait, and ends at once."""

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
