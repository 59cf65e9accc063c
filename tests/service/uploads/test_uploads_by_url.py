"""A file is fetched from hosts that are allowed, and never from a private address, however it is led there."""

import socket
import sys
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import anyio
import httpcore
import pytest

from caesura.service.http.outgoing import checked_connection
from caesura.service.http.outgoing.address_policy import AddressPolicy, ForbiddenAddress
from caesura.service.http.outgoing.allowed_hosts import AllowedHosts
from caesura.service.http.outgoing.checked_connection import CheckedBackend
from caesura.service.problems.problem_response import RequestProblem
from tests.service.conftest import UPLOAD_LIMIT, with_its_own_redis

SITE = "127.0.0.9"
"""The one private address that may be reached: 127.0.0.1 may not."""

PRIVATE = (
    "127.0.0.1", "169.254.169.254", "[::1]", "[::ffff:127.0.0.1]", "[::ffff:7f00:1]", "2130706433", "0x7f.1",
    "017700000001", "0.0.0.0", "localhost", "10.0.0.1", "[fe80::1]", "[64:ff9b::7f00:1]", "100.100.100.200",
)  # fmt: skip

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="127.0.0.9 is an address on Linux alone")


class Site(BaseHTTPRequestHandler):
    """`/take` is a file, `/to?ADDRESS` leads there, `/endless` does not end, `/silent` says nothing."""

    content = b""
    protocol_version = "HTTP/1.1"

    def do_GET(self):
        path, _, rest = self.path.partition("?")
        self.close_connection = True
        getattr(self, path.strip("/").replace("-", "_"))(rest)

    def answer(self, status, body=b"", **headers):
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(body)

    def take(self, _):
        self.answer(200, self.content, Content_Length=str(len(self.content)))

    def named(self, _):
        self.answer(200, self.content, Content_Disposition='attachment; filename="walk.npz"')

    def cut(self, _):
        self.answer(200, self.content[:100], Content_Length=str(len(self.content)))

    def to(self, address):
        self.answer(302, Location=address)

    def round(self, _):
        self.answer(302, Location="/round")

    def missing(self, _):
        self.answer(404)

    def packed(self, _):
        self.answer(200, b"x", Content_Encoding="gzip")

    def huge(self, _):
        self.answer(200, b"x", Content_Length=str(10 * UPLOAD_LIMIT))

    def endless(self, _):
        self.answer(200)
        for _ in range(100 * UPLOAD_LIMIT // 65536):
            self.wfile.write(bytes(65536))

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def site(take):
    Site.content = take(8100)
    server = ThreadingHTTPServer((SITE, 0), Site)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://{SITE}:{server.server_address[1]}"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def fetching(checkout, tmp_path_factory):
    """A service that fetches from every host, and may reach the site."""
    folder = tmp_path_factory.mktemp("fetching")
    with with_its_own_redis(checkout, folder, workers=False, upload_hosts="*", private_networks=SITE) as running:
        yield running


def fetched(running, url, **more):
    return running.http.post("/v1/animations", params={"url": url, **more})


def test_a_file_is_fetched_and_is_what_it_would_be_as_a_body(fetching, site):
    """Under its name there, or one that is given; through redirects; for a segmentation too, by query and JSON."""
    plain = fetching.http.post("/v1/animations", content=Site.content).json()
    for path, name in (("/take", "take"), ("/named", "walk.npz"), ("/to?/named", "walk.npz")):
        answer = fetched(fetching, site + path)
        assert (answer.status_code, answer.json()["id"], answer.json()["name"]) == (200, plain["id"], name)
    assert fetched(fetching, f"{site}/take", name="mine.npz").json()["name"] == "mine.npz"
    by_query = fetching.http.post("/v1/segmentations", params={"url": f"{site}/take", "motions": 3})
    by_json = fetching.http.post("/v1/segmentations", json={"url": f"{site}/take", "motions": 3})
    assert by_query.status_code == by_json.status_code == 202
    assert by_query.json()["id"] == by_json.json()["id"]
    assert not fetching.spooled()


@pytest.mark.parametrize("address", PRIVATE)
def test_no_private_address_is_reached(fetching, site, address):
    """Neither by its own name nor through a redirect; the detail does not say where a name leads."""
    port = site.rpartition(":")[2]
    for url in (f"http://{address}:{port}/take", f"{site}/to?http://{address}:{port}/take"):
        answer = fetched(fetching, url)
        assert (answer.status_code, answer.json()["code"]) == (422, "forbidden-address"), answer.text
    assert not fetching.spooled()


@pytest.mark.parametrize(
    ("path", "status", "code"),
    [
        ("/missing", 422, "fetch-failed"), ("/cut", 422, "fetch-failed"), ("/packed", 422, "fetch-failed"),
        ("/round", 422, "fetch-failed"), ("/to?ftp://example.com/", 422, "invalid-parameter"),
        ("/to?http://a:b@127.0.0.9/take", 422, "invalid-parameter"), ("/nothing-like-it", 422, "fetch-failed"),
        ("/huge", 413, "upload-too-large"), ("/endless", 413, "upload-too-large"),
    ],
)  # fmt: skip
def test_what_cannot_be_taken_is_refused(fetching, site, path, status, code):
    """As soon as that is known, with nothing left in the spool and little memory used."""
    before = fetching.status("VmHWM")
    answer = fetched(fetching, site + path)
    assert (answer.status_code, answer.json()["code"]) == (status, code), answer.text
    assert fetching.status("VmHWM") - before < 16_000_000
    assert not fetching.spooled()


def test_a_silent_server_is_left_and_others_wait_their_turn(fetching):
    """Four at a time; a fifth is told to come back."""
    with socket.create_server((SITE, 0)) as silent:
        url = f"http://{SITE}:{silent.getsockname()[1]}/take"
        waiting = [threading.Thread(target=fetched, args=(fetching, url)) for _ in range(4)]
        for one in waiting:
            one.start()
        silent.settimeout(20)
        held = [silent.accept()[0] for _ in waiting]
        answer = fetched(fetching, url)
        assert (answer.status_code, answer.json()["code"]) == (503, "too-many-fetches")
        began = time.monotonic()
        for one in waiting:
            one.join(30)
        assert time.monotonic() - began < 15
        for connection in held:
            connection.close()
    assert fetched(fetching, f"http://{SITE}:1/").json()["code"] == "fetch-failed"


def test_it_is_off_by_default(idle, site):
    """And hosts are allowed one by one, or all below a name."""
    answer = fetched(idle, f"{site}/take")
    assert (answer.status_code, answer.json()["code"]) == (403, "host-not-allowed")
    hosts = AllowedHosts("files.example.com, *.studio.example")
    for allowed in ("files.example.com", "FILES.example.com", "a.studio.example", "a.b.studio.example"):
        hosts.check(allowed)
    for other in ("example.com", "studio.example", "files.example.com.evil.example", "xstudio.example", "127.0.0.1"):
        with pytest.raises(RequestProblem, match="host-not-allowed"):
            hosts.check(other)


def test_a_name_that_changes_its_address_gains_nothing(monkeypatch):
    """It is looked up once: the connection goes to the address that was checked. The next look-up is checked too."""
    answers = iter([["93.184.216.34"], ["127.0.0.1"], ["93.184.216.34", "127.0.0.1"]])

    async def look_up(host, port, **_):
        return [(socket.AF_INET, socket.SOCK_STREAM, 6, "", (address, port)) for address in next(answers)]

    connected = []

    class Network:
        async def connect_tcp(self, address, *_):
            connected.append(address)
            return "a connection"

    monkeypatch.setattr(checked_connection.anyio, "getaddrinfo", look_up)

    async def connect_thrice():
        backend = CheckedBackend(AddressPolicy())
        backend._network = Network()
        assert await backend.connect_tcp("rebinding.example", 80) == "a connection"
        for _ in range(2):
            with pytest.raises(ForbiddenAddress):
                await backend.connect_tcp("rebinding.example", 80)

    anyio.run(connect_thrice)
    assert connected == ["93.184.216.34"]
    assert issubclass(CheckedBackend, httpcore.AsyncNetworkBackend)
