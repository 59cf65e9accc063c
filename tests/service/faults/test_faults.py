"""What surrounds the service fails: it says so in a sentence, with when to come back, and leaves nothing behind."""

import http.client
import json
import os
import resource
import shutil
import signal
import socket
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from caesura.worker.embedded_redis.server import EmbeddedRedis
from tests.service.conftest import half_upload, serve


@pytest.fixture
def nowhere(monkeypatch):
    """The address of an object store that nobody runs, on a port that is taken and never answers."""
    with socket.create_server(("127.0.0.1", 0)) as silent:
        monkeypatch.setenv("AWS_ENDPOINT", f"http://127.0.0.1:{silent.getsockname()[1]}")
        monkeypatch.setenv("AWS_ALLOW_HTTP", "true")
        monkeypatch.setenv("AWS_ACCESS_KEY_ID", "none")
        monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "none")
        monkeypatch.setenv("AWS_REGION", "none")
        yield "s3://nowhere"


def test_a_store_that_does_not_answer_is_said_before_the_upload_is_read(checkout, idle, tmp_path, nowhere, take):
    """503 with Retry-After, and not ready; the process lives; nothing is kept. It is ready again when the store is."""
    with serve(checkout, tmp_path, idle.redis_url, workers=False, ready=False, store_url=nowhere) as other:
        refused = other.http.post("/v1/segmentations", content=take(901))
        assert (refused.status_code, refused.json()["code"]) == (503, "not-ready")
        assert int(refused.headers["Retry-After"]) >= 1
        assert "Nothing is stored" in refused.json()["detail"]
        assert other.http.get("/readyz").status_code == 503
        assert other.http.get("/healthz").status_code == 200
        assert not other.spooled()


@pytest.mark.skipif(not hasattr(resource, "prlimit"), reason="only Linux limits another process")
def test_a_disk_that_is_full_in_the_middle_of_an_upload_is_said(checkout, idle, tmp_path, take):
    """507, nothing kept, and the next upload that fits is taken."""
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        limits = resource.prlimit(other.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(other.pid, resource.RLIMIT_FSIZE, (10_000, limits[1]))
        refused = other.http.post("/v1/animations", content=take(902))
        assert (refused.status_code, refused.json()["code"]) == (507, "storage-full")
        assert not other.spooled()
        resource.prlimit(other.pid, resource.RLIMIT_FSIZE, limits)
        assert other.http.post("/v1/animations", content=take(902)).status_code == 201


def test_an_upload_that_a_kill_cuts_short_is_gone_at_the_next_start(checkout, idle, tmp_path):
    """The web process is killed in the middle: what it had received is cleared when another one starts."""
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as killed, half_upload(killed):
        os.kill(killed.pid, signal.SIGKILL)
    assert killed.spooled()
    with serve(checkout, tmp_path, idle.redis_url, workers=False) as other:
        assert not other.spooled()


def test_a_disk_that_is_nearly_full_takes_no_more_work(checkout, idle, tmp_path, take):
    """Below CAESURA_MIN_FREE_BYTES: 503 with Retry-After before the file is read, not ready; what is there is read."""
    kept = idle.http.post("/v1/segmentations", content=take(903)).json()["id"]
    more_than_there_is = shutil.disk_usage(tmp_path).total + 1
    settings = {"ready": False, "min_free_bytes": more_than_there_is}
    with serve(checkout, tmp_path, idle.redis_url, workers=False, **settings) as other:
        for call in ("/v1/animations", "/v1/segmentations"):
            refused = other.http.post(call, content=take(904))
            assert (refused.status_code, refused.json()["code"]) == (503, "not-ready"), call
            assert int(refused.headers["Retry-After"]) >= 1
            assert "disk" in refused.json()["detail"]
        assert not other.spooled()
        ready = other.http.get("/readyz")
        assert (ready.status_code, ready.json()["code"]) == (503, "not-ready")
        assert int(ready.headers["Retry-After"]) >= 1
        assert other.http.get(f"/v1/segmentations/{kept}").json()["status"] == "queued"
        assert other.http.delete(f"/v1/segmentations/{kept}").status_code == 200


def test_an_upload_that_would_fill_the_disk_is_refused_as_it_begins(checkout, idle, tmp_path):
    """There is room when it is announced, but not for all of it: 507, before it is received, and nothing is kept."""
    everything = shutil.disk_usage(tmp_path).total
    with serve(checkout, tmp_path, idle.redis_url, workers=False, max_upload_bytes=2 * everything) as other:
        host, port = other.url.removeprefix("http://").split(":")
        with socket.create_connection((host, int(port)), timeout=20) as client:
            head = f"POST /v1/animations HTTP/1.1\r\nHost: localhost\r\nContent-Length: {everything}\r\n\r\n"
            client.sendall(head.encode() + b"glTF" + bytes(1 << 20))
            answer = http.client.HTTPResponse(client)  # it may come in two pieces: head, body
            answer.begin()
            assert (answer.status, json.load(answer)["code"]) == (507, "storage-full")
        assert not other.spooled()


def test_redis_that_is_killed_and_comes_back_is_heard_again(checkout, tmp_path, take):
    """Meanwhile 503 with when to come back; then what was accepted is there, and who waits is woken as before."""
    server = EmbeddedRedis(tmp_path / "redis")
    server.start()
    try:
        with serve(checkout, tmp_path, server.url, workers=False) as other:
            kept = other.http.post("/v1/segmentations", content=take(905)).json()["links"]["self"]
            with ThreadPoolExecutor() as threads:
                cut_off = threads.submit(other.http.get, kept, headers={"Prefer": "wait=30"})
                time.sleep(1.5)  # its file is written once a second
                os.kill(server.pid, signal.SIGKILL)
                assert cut_off.result(30).status_code == 503
                refused = other.http.get(kept)
                assert (refused.status_code, refused.json()["code"]) == (503, "queue-unavailable")
                assert int(refused.headers["Retry-After"]) >= 1
                assert server.ended()
                server.start()
                assert other.http.get(kept).json()["status"] == "queued"
                waiting = threads.submit(other.http.get, kept, headers={"Prefer": "wait=30"})
                time.sleep(0.5)
                assert other.http.delete(kept).json()["status"] == "cancelled"
                assert waiting.result(10).json()["status"] == "cancelled"
    finally:
        server.stop()
