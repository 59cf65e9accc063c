"""Answers are compressed for who takes that; uploads may come as gzip, which no bomb abuses."""

import gzip
import json
import zlib

import httpx
import pytest

from tests.service.conftest import UPLOAD_LIMIT

GZIP = {"Content-Encoding": "gzip"}
EMPTY_MEMBER = gzip.compress(b"")


@pytest.fixture(scope="module")
def address(service, take):
    answer = service.http.post("/v1/segmentations?motions=3", content=take(5711), headers={"Prefer": "wait=30"})
    return answer.json()["links"]["self"]


def raw(service, path, **headers):
    """An answer as it came over the wire."""
    with service.http.stream("GET", path, headers=headers) as answer:
        return answer, b"".join(answer.iter_raw())


@pytest.mark.parametrize("path", ["/result.json", "/result.csv?table=frames", "/result.eaf", "/plot.svg", ""])
@pytest.mark.parametrize("encoding", ["gzip", "zstd"])
def test_text_goes_out_compressed(service, address, path, encoding):
    """As gzip or as zstd, whichever is accepted; the same text in fewer bytes."""
    answer, content = raw(service, address + path, **{"Accept-Encoding": encoding})
    assert answer.headers["Content-Encoding"] == encoding
    assert "Accept-Encoding" in answer.headers["Vary"]
    plain = service.http.get(address + path, headers={"Accept-Encoding": "identity"}).content
    assert len(content) < len(plain)
    if encoding == "gzip":
        assert gzip.decompress(content) == plain
    else:
        assert content.startswith(b"\x28\xb5\x2f\xfd")


@pytest.mark.parametrize("path", ["/viewer/model", "/viewer/strain", "/events"])
def test_files_and_event_streams_do_not(service, address, path):
    """They are packed, or must go out event by event."""
    answer, content = raw(service, address + path, **{"Accept-Encoding": "gzip, zstd"})
    assert content
    assert "Content-Encoding" not in answer.headers


def test_an_upload_may_come_as_gzip(service, take):
    """Raw, in several members, or in a form: it is the animation that it is without."""
    content = take(5712)
    plain = service.http.post("/v1/animations", content=content).json()
    half = len(content) // 2
    for body in (gzip.compress(content), gzip.compress(content[:half]) + gzip.compress(content[half:])):
        answer = service.http.post("/v1/animations", content=body, headers=GZIP)
        assert (answer.status_code, answer.json()["id"]) == (200, plain["id"])
    form = httpx.Request("POST", "http://x", files={"file": ("take.npz", content)})
    headers = GZIP | {"Content-Type": form.headers["Content-Type"]}
    answer = service.http.post("/v1/animations", content=gzip.compress(form.read()), headers=headers)
    assert (answer.status_code, answer.json()["id"]) == (200, plain["id"])
    order = gzip.compress(json.dumps({"animation": plain["id"]}).encode())
    answer = service.http.post("/v1/segmentations", content=order, headers=GZIP | {"Content-Type": "application/json"})
    assert answer.status_code in {200, 202}


def bomb(size):
    """Gzip of so many zeros, a thousandth of their length."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    return b"".join([*(packer.compress(bytes(2**20)) for _ in range(size // 2**20)), packer.flush()])


@pytest.mark.parametrize(
    ("path", "kind", "code"),
    [("/v1/animations", "", "upload-too-large"), ("/v1/segmentations", "application/json", "json-too-long")],
)
def test_a_gzip_bomb_is_refused(service, path, kind, code):
    """As soon as it passes the limit of what comes out, and without the memory for it."""
    body = bomb(40 * UPLOAD_LIMIT)
    before = service.status("VmHWM")
    answer = service.http.post(path, content=body, headers=GZIP | ({"Content-Type": kind} if kind else {}))
    assert answer.json()["code"] == code
    assert service.status("VmHWM") - before < 12_000_000
    assert not service.spooled()


def test_members_without_content_come_to_an_end(service):
    """A thousand may be empty; many more are no file that any program writes."""
    answer = service.http.post("/v1/animations", content=EMPTY_MEMBER * 100_000, headers=GZIP)
    assert (answer.status_code, answer.json()["code"]) == (400, "malformed-gzip")
    assert "small members" in answer.json()["detail"]
    few = EMPTY_MEMBER * 900 + gzip.compress(b"no animation")
    answer = service.http.post("/v1/animations", content=few, headers=GZIP)
    assert (answer.status_code, answer.json()["kind"]) == (415, "unsupported-media")


@pytest.mark.parametrize(
    ("body", "encoding", "status", "code"),
    [
        (b"no gzip at all", "gzip", 400, "malformed-gzip"),
        (gzip.compress(bytes(1000))[:-5], "gzip", 400, "malformed-gzip"),
        (gzip.compress(bytes(1000))[:-5] + b"wrong", "gzip", 400, "malformed-gzip"),
        (b"x", "br", 415, "unsupported-encoding"),
        (b"x", "gzip, gzip", 415, "unsupported-encoding"),
    ],
    ids=["no gzip", "cut off", "wrong end", "brotli", "twice"],  # gzip holds the time, which names of tests must not
)
@pytest.mark.parametrize("path", ["/v1/animations", "/v1/segmentations"])
def test_what_cannot_be_inflated_is_refused(service, path, body, encoding, status, code):
    """With what is wrong, and what is read."""
    answer = service.http.post(path, content=body, headers={"Content-Encoding": encoding})
    assert (answer.status_code, answer.json()["code"]) == (status, code)
    assert answer.headers["Accept-Encoding"] == "gzip"
    assert not service.spooled()


@pytest.mark.parametrize(
    ("header", "query", "name"),
    [
        ('attachment; filename="take one.npz"', "", "take one.npz"),
        ("attachment; filename=\"x.npz\"; filename*=UTF-8''s%C3%A9ance.npz", "", "séance.npz"),
        ('attachment; filename="../../etc/passwd"', "", "passwd"),
        ('attachment; filename="header.npz"', "?name=query.npz", "query.npz"),
        ("attachment; filename*=utf-8''%0d%0aSet-Cookie%3a%20x.npz", "", "Set-Cookie: x.npz"),
        ("attachment", "", "animation.npz"),
    ],
)
def test_an_upload_keeps_its_name(service, take, header, query, name):
    """Of Content-Disposition, unless the query says otherwise; nothing of it is a path or ends a header."""
    address = f"/v1/animations{query}"
    made = service.http.post(address, content=take(hash(header) % 10**6), headers={"Content-Disposition": header})
    assert made.json()["name"] == name
    file = service.http.get(made.json()["links"]["file"])
    assert "Set-Cookie" not in file.headers
