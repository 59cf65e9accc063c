"""An upload goes on where it broke off, by tus 1.0: however often it is cut, the bytes are those that were sent."""

import base64
import random
import socket
import threading
import time

import httpx
import pytest

from caesura.service.uploads.resumable.upload_records import MOST_UPLOADS
from tests.service.conftest import UPLOAD_LIMIT

TUS = {"Tus-Resumable": "1.0.0"}
PIECE = TUS | {"Content-Type": "application/offset+octet-stream"}


def begin(running, content, name="walk.npz"):
    """The address of a new upload."""
    metadata = f"filename {base64.b64encode(name.encode()).decode()},is_final"
    headers = TUS | {"Upload-Length": str(len(content)), "Upload-Metadata": metadata}
    answer = running.http.post("/v1/uploads", headers=headers)
    assert answer.status_code == 201, answer.text
    assert answer.headers["Tus-Resumable"] == "1.0.0"
    return answer.headers["Location"]


def offset(running, address):
    head = running.http.head(address, headers=TUS)
    assert head.status_code == 200
    assert head.headers["Cache-Control"] == "no-store"
    return int(head.headers["Upload-Offset"])


def piece(running, address, start, content):
    return running.http.patch(address, content=content, headers=PIECE | {"Upload-Offset": str(start)})


def cut(running, address, content, start, sent):
    """Send a piece, but only so many bytes of it, and hang up."""
    place = httpx.URL(running.url)
    head = (
        f"PATCH {address} HTTP/1.1\r\nHost: localhost\r\nTus-Resumable: 1.0.0\r\nUpload-Offset: {start}\r\n"
        f"Content-Type: application/offset+octet-stream\r\nContent-Length: {len(content) - start}\r\n\r\n"
    )
    with socket.create_connection((place.host, place.port)) as line:
        line.sendall(head.encode() + content[start : start + sent])
        time.sleep(0.05)


def settled_offset(running, address):
    """The offset once the broken connection is noticed: two answers in a row that are the same."""
    before = -1
    while (now := offset(running, address)) != before:
        before = now
        time.sleep(0.15)
    return now


def test_an_upload_that_is_cut_again_and_again_is_whole_in_the_end(idle, take):
    """Every try gets further, and what comes out is the very file, under its name."""
    content, odd = take(9100), random.Random(9)
    address, start, cuts = begin(idle, content), 0, 0
    while cuts < 6:
        sent = odd.randrange(1, (len(content) - start) // 3)
        cut(idle, address, content, start, sent)
        after = settled_offset(idle, address)
        assert start <= after <= start + sent
        # A server that is busy first sees a line that is cut already: nothing has come, and that is no try.
        start, cuts = after, cuts + (after > start)
    answer = piece(idle, address, start, content[start:])
    assert (answer.status_code, answer.headers["Upload-Offset"]) == (204, str(len(content)))
    animation = idle.http.get(answer.headers["Content-Location"]).json()
    assert (animation["name"], animation["bytes"]) == ("walk.npz", len(content))
    assert idle.http.get(animation["links"]["file"]).content == content
    again = idle.http.get(address).json()
    assert (again["offset"], again["animation"]) == (len(content), animation["id"])
    assert piece(idle, address, len(content), b"").headers["Content-Location"] == answer.headers["Content-Location"]
    assert idle.http.post("/v1/animations", content=content).json()["id"] == animation["id"]
    assert not list((idle.data / "scratch" / "resumable").iterdir())


def test_a_piece_must_go_on_where_the_last_one_ended(idle, take):
    """409 with how much there is; nothing is written."""
    content = take(9101)
    address = begin(idle, content)
    assert piece(idle, address, 0, content[:1000]).status_code == 204
    for start in (0, 999, 1001, 10**9):
        answer = piece(idle, address, start, content[1000:2000])
        assert (answer.status_code, answer.json()["code"], answer.json()["actual"]) == (409, "wrong-offset", 1000)
    too_long = piece(idle, address, 1000, content)
    assert (too_long.status_code, too_long.json()["code"]) == (413, "piece-too-long")
    assert offset(idle, address) == 1000
    assert idle.http.delete(address, headers=TUS).status_code == 204
    assert idle.http.head(address, headers=TUS).status_code == 404


def test_one_request_writes_at_a_time(idle, take):
    """Another is told so, and neither is lost."""
    content = take(9102)
    address = begin(idle, content)
    gate = threading.Event()

    def slow():
        yield content[:1000]
        gate.wait(10)
        yield content[1000:]

    answers = []
    writing = threading.Thread(target=lambda: answers.append(httpx.patch(
        idle.url + address, content=slow(), headers=PIECE | {"Upload-Offset": "0"}, timeout=30
    )))  # fmt: skip
    writing.start()
    time.sleep(0.5)
    for busy in (piece(idle, address, 0, content), idle.http.delete(address)):
        assert (busy.status_code, busy.json()["code"]) == (423, "upload-busy")
    gate.set()
    writing.join(30)
    assert answers[0].status_code == 204
    assert "Content-Location" in answers[0].headers


def test_the_protocol_is_told_and_asked_for(idle, take):
    """OPTIONS, the version, the longest upload; a file that cannot be read is refused at its end and forgotten."""
    options = idle.http.options("/v1/uploads")
    assert options.status_code == 204
    assert options.headers["Tus-Version"] == "1.0.0"
    assert options.headers["Tus-Max-Size"] == str(UPLOAD_LIMIT)
    assert set(options.headers["Tus-Extension"].split(",")) == {"creation", "expiration", "termination"}
    other = idle.http.post("/v1/uploads", headers={"Tus-Resumable": "0.2.2", "Upload-Length": "1"})
    assert (other.status_code, other.headers["Tus-Version"]) == (412, "1.0.0")
    large = idle.http.post("/v1/uploads", headers=TUS | {"Upload-Length": str(UPLOAD_LIMIT + 1)})
    assert (large.status_code, large.json()["code"]) == (413, "upload-too-large")
    for length in ("-1", "many", "", "1" * 30):
        assert idle.http.post("/v1/uploads", headers=TUS | {"Upload-Length": length}).status_code == 422
    address = begin(idle, b"no animation", "../../etc/passwd")
    assert idle.http.get(address).json()["name"] == "passwd"
    typed = idle.http.patch(address, content=b"x", headers=TUS | {"Upload-Offset": "0", "Content-Type": "text/plain"})
    assert (typed.status_code, typed.json()["code"]) == (415, "unsupported-media-type")
    answer = piece(idle, address, 0, b"no animation")
    assert (answer.status_code, answer.json()["code"]) == (415, "unsupported-media-type")
    assert idle.http.head(address).status_code == 404


def test_unfinished_uploads_are_bounded_and_pieces_of_forgotten_ones_go(idle):
    """So many for each owner; what Redis has forgotten is deleted from the disk with the next that begins."""
    folder = idle.data / "scratch" / "resumable"
    folder.mkdir(exist_ok=True)
    (folder / "forgotten").write_bytes(b"x")
    made = []
    while (answer := idle.http.post("/v1/uploads", headers={"Upload-Length": "9"})).status_code == 201:
        made.append(answer.headers["Location"])
    assert len(made) <= MOST_UPLOADS
    assert (answer.status_code, answer.json()["code"]) == (429, "too-many-uploads")
    assert not (folder / "forgotten").exists()
    for address in made:
        assert idle.http.delete(address).status_code == 204


@pytest.mark.parametrize("metadata", ["filename !!!", "filename //8=", "x" * 5000])
def test_metadata_that_cannot_be_read_is_refused(idle, metadata):
    """As a wrong parameter."""
    answer = idle.http.post("/v1/uploads", headers={"Upload-Length": "9", "Upload-Metadata": metadata})
    assert (answer.status_code, answer.json()["parameter"]) == (422, "Upload-Metadata")
