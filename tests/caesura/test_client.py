"""`caesura.Client` and `caesura.AsyncClient`, against a running service and against one that misbehaves."""

import asyncio
import http.server
import json
import pickle
import socketserver
import subprocess
import sys
import threading
from typing import ClassVar

import pytest

from caesura import AsyncClient, Client, Segmentation, segment
from caesura.client.errors import ServiceProblem, Unreachable
from caesura.client.upload import Upload
from caesura.core.errors import ParameterError
from caesura.service.commands.local_service import local_service
from tests.formats.point_caches import MESH, folding_sheet, pc2
from tests.installation import take_npz


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    """The URL of a service with a data folder of its own."""
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("CAESURA_DATA_DIR", str(tmp_path_factory.mktemp("data")))
        environment.delenv("REDIS_URL", raising=False)
        with local_service(0) as url:
            yield url


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    place = tmp_path_factory.mktemp("takes") / "take & é.npz"
    place.write_bytes(take_npz())
    return place


def asked(kind, url, call, *arguments, **given):
    """One call of a client of either kind, which is closed after it."""
    if kind is Client:
        with Client(url) as client:
            return getattr(client, call)(*arguments, **given)

    async def ask():
        async with AsyncClient(url) as client:
            return await getattr(client, call)(*arguments, **given)

    return asyncio.run(ask())


BOTH = pytest.mark.parametrize("kind", [Client, AsyncClient])


@BOTH
def test_a_file_goes_the_whole_way(service, path, tmp_path, kind):
    """Upload, wait, result, files of it, and gone; the result is what this machine computes."""
    stages = []
    found = asked(
        kind, service, "segment", path, motions=2, progress=lambda stage, share: stages.append((stage, share))
    )
    assert stages[-1][1] <= 1
    assert ("uploading", 1.0) in stages
    local = segment(path, motions=2)
    assert found.segments == local.segments
    assert Segmentation.of(found).labels.tolist() == local.labels.tolist()
    assert asked(kind, service, "status", found.id)["name"] == path.name
    assert asked(kind, service, "wait", found.id)["status"] == "done"
    assert asked(kind, service, "result", found.id) == found
    clips = asked(kind, service, "download", found.id, "clips", tmp_path / "clips.zip", keep_source=False)
    assert (tmp_path / "clips.zip").read_bytes() == clips
    assert clips.startswith(b"PK")
    asked(kind, service, "delete", found.id)
    with pytest.raises(ServiceProblem) as gone:
        asked(kind, service, "status", found.id)
    assert gone.value.problem()["status"] == 404
    assert pickle.loads(pickle.dumps(gone.value)).problem() == gone.value.problem()


@BOTH
def test_files_that_belong_together_are_sent_as_one(service, tmp_path, kind):
    """A point cache and its mesh."""
    (tmp_path / "take.pc2").write_bytes(pc2(folding_sheet()))
    (tmp_path / "take.obj").write_bytes(MESH)
    found = asked(kind, service, "segment", [tmp_path / "take.pc2", tmp_path / "take.obj"], motions=1)
    assert found.frames == len(folding_sheet())


@BOTH
def test_a_refusal_is_the_services_own(service, kind):
    """With its code; a parameter is refused before anything is sent, a port where nobody listens by a sentence."""
    with pytest.raises(ServiceProblem, match="unsupported-media-type"):
        asked(kind, service, "segment", b"<html>")
    with pytest.raises(ParameterError, match="motion'"):
        asked(kind, "http://127.0.0.1:9", "segment", b"<html>", motion=2)
    with pytest.raises(Unreachable, match=r"No answer from http://127.0.0.1:9: .+"):
        asked(kind, "127.0.0.1:9", "segment", b"<html>")


class Scripted(http.server.BaseHTTPRequestHandler):
    """Answers as it is told to, in order, and remembers how much it was sent."""

    answers: ClassVar[list[tuple]] = []
    received: ClassVar[list[int]] = []

    def do_POST(self):
        self.received.append(len(self.rfile.read(int(self.headers["Content-Length"]))))
        self.do_GET()

    def do_GET(self):
        status, headers, content = self.answers.pop(0)
        self.send_response(status)
        for name, value in {"Content-Length": str(len(content)), **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_):
        pass


@pytest.fixture
def scripted(monkeypatch):
    """A server that does what the test says."""
    monkeypatch.setattr(Scripted, "answers", [])
    monkeypatch.setattr(Scripted, "received", [])
    with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Scripted) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_address[1]}", Scripted
        server.shutdown()
        thread.join()


DOCUMENT = {"Content-Type": "application/json"}
BUSY = json.dumps({"code": "too-many-jobs", "detail": "Come again."}).encode()


@BOTH
def test_a_busy_service_is_asked_again_when_it_said(scripted, kind):
    """With the whole body each time; one that never has time is a refusal after four times."""
    url, server = scripted
    done = json.dumps({"id": "x", "status": "done"}).encode()
    busy = (503, {"Retry-After": "1", **DOCUMENT}, BUSY)
    server.answers += [busy, (202, DOCUMENT, done)]
    assert asked(kind, url, "submit", b"content")["id"] == "x"
    assert server.received == [7, 7]
    server.answers += [(429, {"Retry-After": "1", **DOCUMENT}, BUSY)] * 4
    with pytest.raises(ServiceProblem, match="Come again"):
        asked(kind, url, "status", "x")
    server.answers += [(503, DOCUMENT, BUSY)]
    with pytest.raises(ServiceProblem):
        asked(kind, url, "status", "x")
    assert server.answers == []


@BOTH
@pytest.mark.parametrize(
    "answer",
    [
        (200, {"Content-Type": "text/html"}, b"<html>"),
        (404, {"Content-Type": "text/html"}, b"<html>"),
        (500, DOCUMENT, b"{"),
        (200, DOCUMENT, b"[]"),
    ],
    ids=["page", "no page", "broken", "list"],
)
def test_another_server_is_no_service(scripted, kind, answer):
    """What is not ours is said with its status, and no word of it is believed."""
    url, server = scripted
    server.answers.append(answer)
    with pytest.raises(Unreachable, match=f"answered {answer[0]} to GET .*no Caesura service"):
        asked(kind, url, "status", "x")


def test_a_failed_segmentation_is_its_problem(scripted):
    """Waiting ends with what went wrong, or with its being cancelled."""
    url, server = scripted
    failed = {"id": "x", "status": "failed", "problem": {"code": "no-motion", "detail": "Nothing moves."}}
    cancelled = {"id": "x", "status": "cancelled", "problem": None}
    for document, said in ((failed, "Nothing moves"), (cancelled, "It was cancelled")):
        server.answers.append((200, DOCUMENT, json.dumps(document).encode()))
        with pytest.raises(ServiceProblem, match=said):
            asked(Client, url, "wait", "x")


def test_the_length_of_a_form_is_said_before_it():
    """As long as the pieces that follow, for names that need quoting too."""
    upload = Upload({"a.gltf": memoryview(b"{}"), 'b "é".bin': memoryview(bytes(600_000))})
    body = b"".join(upload.pieces())
    assert int(upload.headers["Content-Length"]) == len(body)
    assert max(map(len, upload.pieces())) <= 2**18


def test_a_client_without_httpx_says_what_to_install():
    """And nothing else of the package needs it."""
    program = (
        "import sys; sys.modules['httpx'] = None\nimport caesura\nfrom caesura import segment\n"
        "try:\n    caesura.Client\nexcept ImportError as missing:\n    print(missing)"
    )
    run = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert 'pip install "caesura[client]"' in run.stdout
