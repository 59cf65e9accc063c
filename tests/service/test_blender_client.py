"""The Blender add-on's client, without Blender, against the running service."""

import http.server
import threading

import pytest

from blender.caesura_addon.segments import Segment, revision_of_segments, segments_of_document
from blender.caesura_addon.service_client import ServiceClient, ServiceError
from blender.caesura_addon.sliced_work import Cancelled
from tests.installation import take_npz


@pytest.fixture
def take(tmp_path):
    path = tmp_path / "take.npz"
    path.write_bytes(take_npz((0, 1, 0, 2)))
    return path


def ignore(stage, fraction):
    pass


def test_a_take_is_sent_cut_and_corrected(service, take):
    client, said = ServiceClient(service.url), []
    animation = client.upload(take, "rig.glb", lambda *report: said.append(report))
    assert said[-1] == ("sending", 1.0)
    document = client.segment(animation, {"motions": 2}, ignore)
    assert (document["frames"], document["motions"], document["revision"]) == (240, 2, 0)
    found = segments_of_document(document)
    corrected = [Segment(0, 70, "walk", loop=True), Segment(70, 240, found[0].name)]
    edits = revision_of_segments(corrected)
    assert client.save_revision(document["id"], 0, edits, "by hand")["revision"] == 1
    again = client.segment(animation, {"motions": 2}, ignore)
    assert (again["revision"], segments_of_document(again)) == (1, corrected)
    with pytest.raises(ServiceError) as refused:
        client.save_revision(document["id"], 0, edits, "once more")
    assert refused.value.code == "stale-revision"


def test_a_refusal_is_the_services_own_sentence(service, tmp_path):
    path = tmp_path / "take"
    path.write_bytes(b"no animation")
    with pytest.raises(ServiceError) as refused:
        ServiceClient(service.url).upload(path, "take", ignore)
    assert refused.value.code == "unsupported-media-type"
    assert service.http.get("/v1/limits").json() == ServiceClient(service.url).limits()


def test_an_upload_that_is_cancelled_ends(service, take):
    stop = threading.Event()
    stop.set()
    with pytest.raises(Cancelled):
        ServiceClient(service.url, stop=stop).upload(take, "rig.glb", ignore)


def test_a_segmentation_that_is_cancelled_is_cancelled_at_the_service(idle, take):
    stop = threading.Event()
    client = ServiceClient(idle.url, stop=stop)
    animation = client.upload(take, "rig.glb", ignore)
    with pytest.raises(Cancelled):
        client.segment(animation, {"motions": 2}, lambda *_: stop.set())
    newest = idle.http.get("/v1/segmentations", params={"animation": animation}).json()["segmentations"][0]
    assert newest["status"] == "cancelled"


@pytest.mark.parametrize("address", ["", "ftp://localhost", "http://"])
def test_what_is_no_address_is_said(address):
    with pytest.raises(ServiceError, match="no address"):
        ServiceClient(address)


def test_where_nobody_answers_is_said():
    with pytest.raises(ServiceError, match="No answer from"):
        ServiceClient("127.0.0.1:9").limits()


def test_another_program_is_no_service_and_a_key_follows_no_redirection():
    seen = []

    class Elsewhere(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            seen.append(self.path)
            self.send_response(302)
            self.send_header("Location", "/stolen")
            self.end_headers()

        def log_message(self, *_):
            pass

    server = http.server.HTTPServer(("127.0.0.1", 0), Elsewhere)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        with pytest.raises(ServiceError, match="no Caesura service"):
            ServiceClient(f"http://127.0.0.1:{server.server_port}", "secret").limits()
    finally:
        server.shutdown()
        server.server_close()
    assert seen == ["/v1/limits"]
