"""Files come in by every way that curl knows, a block at a time, and leave nothing where they are refused."""

import shutil
import socket
import subprocess
import time

import httpx
import pytest

from tests.service.conftest import UPLOAD_LIMIT, npz

MEGABYTE = 10**6


def posted(service, path, *arguments):
    """What curl hears: (status, JSON)."""
    command = ["curl", "-sS", "-X", "POST", *arguments, "-w", "\n%{http_code}", f"{service.url}{path}"]
    if shutil.which("curl") is None:
        pytest.skip("no curl on this machine")
    output = subprocess.run(command, check=True, capture_output=True, text=True, timeout=60).stdout
    body, status = output.rsplit("\n", 1)
    return int(status), httpx.Response(200, text=body).json()


def test_every_way_of_sending_the_same_bytes_is_the_same_animation(service, take, tmp_path):
    """curl -T, --data-binary with its form type, -F, and a client's multipart: one id, created once."""
    file = tmp_path / "bar.npz"
    file.write_bytes(take(101))
    ways = [
        posted(service, "/v1/animations?name=bar.npz", "-T", str(file)),
        posted(service, "/v1/animations", "--data-binary", f"@{file}"),
        posted(service, "/v1/animations", "-F", f"file=@{file}"),
        posted(service, "/v1/animations", "-F", f"anything=@{file};filename=other.bin", "-F", "name=other"),
    ]
    assert [status for status, _ in ways] == [201, 200, 200, 200]
    assert len({document["id"] for _, document in ways}) == 1
    assert ways[0][1]["name"] == "bar.npz"
    assert not service.spooled()


def test_an_upload_is_described_by_its_header(service, take):
    """Takes, vertices and triangles are told at once, before any worker has seen the file."""
    answer = service.http.post("/v1/animations", params={"name": "C:\\takes\\bar.npz"}, content=take(102))
    document = answer.json()
    assert answer.status_code == 201
    assert answer.headers["Location"] == f"/v1/animations/{document['id']}"
    assert document["name"] == "bar.npz"
    assert document["format"] == "npz"
    assert document["vertices"] == 96
    assert document["takes"][0]["frames"] == 240
    assert document["takes"][0]["frame_rate"] == 30


@pytest.mark.parametrize(
    ("head", "named"),
    [
        (b"<!DOCTYPE html><html>", "HTML"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:00", "LFS"),
        (b"\x89PNG\r\n\x1a\n", "PNG"),
        (b"", "empty"),
        (b"\0" * 100, "not known"),
    ],
)
def test_other_kinds_of_file_are_named_and_refused(service, head, named):
    """415, in a problem document that says what the file is, by every way of sending it."""
    forms = [{"content": head}, {"files": {"file": ("take.glb", head)}}]
    for body in forms:
        for path in ("/v1/animations", "/v1/segmentations"):
            answer = service.http.post(path, **body)
            assert answer.status_code == 415
            assert answer.headers["Content-Type"] == "application/problem+json"
            assert answer.json()["code"] == "unsupported-media-type"
            assert named in answer.json()["detail"]
    assert not service.spooled()


@pytest.mark.parametrize(
    "body",
    [
        b"glTF",
        b"glTF\x01\0\0\0" + b"\0" * 40,
        b"glTF\x02\0\0\0\xff\xff\xff\xffxxxxJSON",
        b"PK\x03\x04" + b"\0" * 100,
        b"{" * 100_000,
        b'{"asset": NaN}',
        b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "file:///etc/passwd", "byteLength": 4}]}',
        npz(vertices=["a", "text"]),
    ],
    ids=range(8),
)
def test_hostile_files_get_a_problem_document(service, body):
    """Refused at the door or by the worker, never with a 500 and never with a traceback."""
    answer = service.http.post("/v1/segmentations", content=body, headers={"Prefer": "wait=20"})
    assert 400 <= answer.status_code < 500
    assert answer.headers["Content-Type"] == "application/problem+json"
    assert {"type", "title", "status", "detail", "code"} <= answer.json().keys()
    assert "Traceback" not in answer.text


def chunks(size, head=b"glTF"):
    """A body of that many bytes, made as it is sent."""
    yield head.ljust(MEGABYTE, b"\0")
    for _ in range(size // MEGABYTE - 1):
        yield bytes(MEGABYTE)


def form(size, boundary=b"between"):
    """The same as a form of one file."""
    yield b"--" + boundary + b'\r\nContent-Disposition: form-data; name="file"; filename="take.npz"\r\n\r\n'
    yield from chunks(size)
    yield b"\r\n--" + boundary + b"--\r\n"


FORM = {"Content-Type": "multipart/form-data; boundary=between"}


@pytest.mark.parametrize("announced", [True, False])
@pytest.mark.parametrize(("body", "headers"), [(chunks, {}), (form, FORM)], ids=["raw", "form"])
def test_an_upload_over_the_limit_is_refused_midway(service, body, headers, announced):
    """413 with the limit, the size and the setting, as soon as it is known; nothing stays on the disk."""
    size = 4 * UPLOAD_LIMIT
    length = {"Content-Length": str(sum(map(len, body(size))))} if announced else {}
    answer = service.http.post("/v1/animations", content=body(size), headers={**headers, **length})
    problem = answer.json()
    assert answer.status_code == 413
    assert problem["code"] == "upload-too-large"
    assert problem["limit"] == UPLOAD_LIMIT
    assert UPLOAD_LIMIT < problem["actual"] <= (4 * UPLOAD_LIMIT + 500 if announced else 2 * UPLOAD_LIMIT)
    assert problem["setting"] == "CAESURA_MAX_UPLOAD_BYTES"
    assert not service.spooled()


def test_an_upload_that_breaks_off_leaves_nothing(service):
    """The client hangs up in the middle: the partial file is deleted, and the service goes on."""
    host, port = service.url.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port))) as half:
        half.sendall(
            b"POST /v1/animations HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5000000\r\n\r\nglTF" + bytes(2_000_000)
        )
        _until(service.spooled)
    _until(lambda: not service.spooled())
    assert service.http.get("/healthz").status_code == 200


def _until(condition, seconds=10):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


@pytest.mark.parametrize(
    ("body", "code"),
    [
        (b"no form at all", "malformed-multipart"),
        (b'--between\r\nContent-Disposition: form-data; name="f"; filename="a"\r\n\r\nglTF', "malformed-multipart"),
        (b'--between\r\nContent-Disposition: form-data; name="name"\r\n\r\nx\r\n--between--\r\n', "no-file"),
        (b'--between\r\nContent-Disposition: form-data; name="f"\r\n\r\n' + b"x" * 5000, "field-too-long"),
        (b'--between\r\nContent-Disposition: form-data; name="f"; filename="a"\r\n\r\nx\r\n' * 65, "too-many-parts"),
        (b'--between\r\nContent-Disposition: form-data; name="f"\r\n\r\nx\r\n' * 65, "too-many-parts"),
        (
            b'--between\r\nContent-Disposition: form-data; name="f"; filename="a"\r\n\r\nglTF\r\n' * 2 + b"--between--",
            "duplicate-part",
        ),
    ],
)
def test_broken_forms_are_refused(service, body, code):
    """Truncated, without a file, with too many: each has its code, and nothing stays on the disk."""
    answer = service.http.post("/v1/animations", content=body, headers=FORM)
    assert answer.status_code in {400, 422}
    assert answer.json()["code"] == code
    assert not service.spooled()


@pytest.mark.parametrize(("body", "headers"), [(chunks, {}), (form, FORM)], ids=["raw", "form"])
def test_memory_does_not_grow_with_the_upload(service, body, headers):
    """Eight megabytes pass through the web process, which keeps less than three of them at any time."""
    with httpx.Client(base_url=service.url, timeout=60) as http:
        cold = service.status("VmRSS")
        http.post("/v1/animations", content=body(UPLOAD_LIMIT), headers=headers)
        before = service.status("VmRSS")
        assert before - cold < UPLOAD_LIMIT  # buffers of the first are kept for the next, and no upload
        for _ in range(3):
            http.post("/v1/animations", content=body(UPLOAD_LIMIT), headers=headers)
    assert service.status("VmRSS") - before < 3 * MEGABYTE
    assert service.status("VmHWM") < 150 * MEGABYTE
