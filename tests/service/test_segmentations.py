"""A segmentation is asked for once, however often it is asked for, and can be followed, waited for and cancelled."""

import json
import socket
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import httpx
import pytest

from caesura.service.http.stream_limit import MOST_STREAMS
from tests.glb import moving_square
from tests.service.conftest import npz

PREFER = {"Prefer": "wait=30"}


def test_one_curl_does_it_all(service, take, tmp_path):
    """The file as the body, K in the query, a wait in a header: segments that tile the take come back."""
    file = tmp_path / "bar.npz"
    file.write_bytes(take(301))
    command = ["curl", "--fail", "-sS", "-X", "POST", "-T", file, f"{service.url}/v1/segmentations?motions=3"]
    status = json.loads(subprocess.run([*command, "-H", "Prefer: wait=30"], check=True, capture_output=True).stdout)
    assert status["status"] == "done"
    bounds = [(segment["start"], segment["end"]) for segment in status["segments"]]
    assert bounds[0][0] == 0
    assert bounds[-1][1] == status["frames"] == 240
    assert all(left[1] == right[0] for left, right in pairwise(bounds))
    assert status["motions"] == len({segment["motion"] for segment in status["segments"]})


def test_the_same_again_is_the_same_segmentation(service, take, tmp_path):
    """By upload, by form, by JSON, with defaults spelled out: one id, answered at once and never queued again."""
    content = take(302)
    first = service.http.post("/v1/segmentations?motions=3", content=content, headers=PREFER)
    document = first.json()
    assert first.status_code == 200
    assert first.headers["Preference-Applied"] == "wait=30"
    record = service.http.get(f"/v1/segmentations/{document['id']}/events").text
    again = [
        service.http.post("/v1/segmentations?motions=3&take=longest", content=content),
        service.http.post("/v1/segmentations?motions=3&take=0&bins=10", content=content),
        service.http.post("/v1/segmentations?motions=3", files={"file": ("animation.npz", content)}),
        service.http.post("/v1/segmentations", files={"file": ("animation.npz", content)}, data={"motions": "3"}),
        service.http.post("/v1/segmentations", json={"animation": document["animation"], "motions": 3}),
        service.http.post("/v1/segmentations", params={"animation": document["animation"], "motions": "3"}),
    ]
    assert [answer.status_code for answer in again] == [200] * 6
    assert {answer.json()["id"] for answer in again} == {document["id"]}
    assert service.http.get(f"/v1/segmentations/{document['id']}/events").text == record, "it was computed again"


def test_all_takes_of_a_file_are_one_segmentation(service):
    """One after the other; of a file with one take it is that take."""
    model = moving_square()
    (one,) = model.json["animations"]
    single = model.glb()
    model.json["animations"] = [{**one, "name": name} for name in ("a", "b", "c")]
    frames = []
    for content in (single, model.glb()):
        status = service.http.post("/v1/segmentations?take=all", content=content, headers=PREFER).json()
        frames.append((status["frames"], status["parameters"]["take"]))
    assert frames == [(31, 0), (93, "all")]


def test_other_parameters_are_another_segmentation_of_the_same_animation(service, take):
    """Both are listed, newest first."""
    content = take(303)
    two, three = (
        service.http.post(f"/v1/segmentations?motions={k}", content=content, headers=PREFER).json() for k in (2, 3)
    )
    assert two["animation"] == three["animation"]
    listed = service.http.get("/v1/segmentations", params={"animation": two["animation"]}).json()["segmentations"]
    assert [one["id"] for one in listed] == [three["id"], two["id"]]
    assert [one["segments"] for one in listed] == [None, None]  # a long take has thousands


def test_without_a_wait_the_answer_comes_at_once(idle, take):
    """202, where to ask, when to ask, and how many come before."""
    answer = idle.http.post("/v1/segmentations", content=take(304))
    status = answer.json()
    assert answer.status_code == 202
    assert answer.headers["Location"] == f"/v1/segmentations/{status['id']}"
    assert answer.headers["Retry-After"] == "1"
    assert status["status"] == "queued"
    assert isinstance(status["position"], int)
    assert "Preference-Applied" not in answer.headers


def test_a_wait_that_is_too_short_ends_with_what_there_is(idle, take):
    """202 after the second that was granted."""
    answer = idle.http.post("/v1/segmentations", content=take(305), headers={"Prefer": "respond-async, wait=1"})
    assert answer.status_code == 202
    assert answer.headers["Preference-Applied"] == "wait=1"
    assert 0.9 < answer.elapsed.total_seconds() < 3


def test_what_is_not_finished_has_no_result(idle, take):
    """409 for result and figure, with a hint when to come back."""
    identifier = idle.http.post("/v1/segmentations", content=take(306)).json()["id"]
    for path in ("result", "result.csv", "result.npz", "viewer", "viewer/model"):
        answer = idle.http.get(f"/v1/segmentations/{identifier}/{path}")
        assert answer.status_code == 409
        assert answer.json()["code"] == "not-finished"
        assert answer.headers["Retry-After"] == "1"


def test_delete_cancels_first_and_deletes_then(idle, take):
    """Queued, cancelled, gone; posting the same again after a cancel starts anew."""
    content = take(307)
    identifier = idle.http.post("/v1/segmentations", content=content).json()["id"]
    address = f"/v1/segmentations/{identifier}"
    assert idle.http.delete(address).json()["status"] == "cancelled"
    assert idle.http.get(address).json()["status"] == "cancelled"
    assert idle.http.get(f"{address}/result").json()["code"] == "cancelled"
    assert idle.http.post("/v1/segmentations", content=content).json()["status"] == "queued"
    idle.http.delete(address)
    assert idle.http.delete(address).status_code == 204
    assert idle.http.get(address).status_code == 404


def test_a_take_that_is_not_there_is_refused_at_once(idle, take):
    """422 naming the parameter and the takes there are; nothing is queued."""
    answer = idle.http.post("/v1/segmentations?take=walk", content=take(308))
    assert answer.status_code == 422
    assert answer.json()["parameter"] == "take"


@pytest.mark.parametrize(
    ("query", "code", "named"),
    [
        ("motoins=3", "unknown-parameter", "motions"),
        ("motions=3&motions=4", "repeated-parameter", "motions"),
        ("motions=none", "invalid-parameter", "motions"),
        ("fps=-1", "invalid-parameter", "fps"),
        ("method=magic", "invalid-parameter", "method"),
        ("window_seconds=1e999", "invalid-parameter", "window_seconds"),
    ],
)
def test_wrong_parameters_are_refused_before_the_upload(idle, query, code, named):
    """422 in one sentence that names the parameter, whatever the body is."""
    answer = idle.http.post(f"/v1/segmentations?{query}", content=b"<html>")
    assert answer.status_code == 422
    assert answer.json()["code"] == code
    assert named in answer.json()["detail"]


@pytest.mark.parametrize(
    ("body", "status", "code"),
    [
        (b"[", 400, "malformed-json"),
        (b"[1]", 400, "malformed-json"),
        (b'{"animation": "\\ud800"}', 400, "malformed-json"),
        (b'{"animation": "x", "\\ud800": 1}', 400, "malformed-json"),
        (b"[" * 60_000, 400, "malformed-json"),
        (b"{}", 422, "missing-parameter"),
        (b'{"animation": 5}', 422, "invalid-parameter"),
        (b'{"animation": "x", "motoins": 3}', 404, "not-found"),
        (b" " * 300_000, 400, "json-too-long"),
    ],
)
def test_wrong_json_is_refused(idle, body, status, code):
    """Each fault has its status and its code."""
    answer = idle.http.post("/v1/segmentations", content=body, headers={"Content-Type": "application/json"})
    assert (answer.status_code, answer.json()["code"]) == (status, code)


def test_a_segmentation_that_failed_answers_its_own_problem(service, take):
    """A still take has no motion: 4xx when posted and when its result is asked for, 200 for its status."""
    still = npz(vertices=[[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], triangles=[[0, 1, 2]])
    answer = service.http.post("/v1/segmentations", content=still, headers=PREFER)
    assert answer.status_code == 422
    assert answer.json()["code"] == "no-motion"


def test_events_tell_every_change_to_the_end(service, take):
    """An opening comment, status documents with ids, and the last says that it is done."""
    identifier = service.http.post("/v1/segmentations", content=take(309)).json()["id"]
    with service.http.stream("GET", f"/v1/segmentations/{identifier}/events") as stream:
        assert stream.headers["Content-Type"].startswith("text/event-stream")
        lines = list(stream.iter_lines())
    assert lines[0].startswith(":")
    seen = [json.loads(line.removeprefix("data: "))["status"] for line in lines if line.startswith("data: ")]
    assert seen[-1] == "done"
    last = [line.removeprefix("id: ") for line in lines if line.startswith("id: ")][-1]
    again = service.http.get(f"/v1/segmentations/{identifier}/events", headers={"Last-Event-ID": last})
    assert again.status_code == 204


def test_there_is_an_end_to_open_streams(idle, take):
    """One too many is refused and told what to do; where another is left there is room again."""
    address = idle.http.post("/v1/segmentations", content=take(67)).json()["links"]["events"]
    place = httpx.URL(idle.url)

    def opened():
        client = socket.create_connection((place.host, place.port), timeout=20)
        client.sendall(f"GET {address} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        return client, client.recv(1 << 12).split()[1]

    streams = [opened() for _ in range(MOST_STREAMS)]
    assert {status for _, status in streams} == {b"200"}
    refused = idle.http.get(address)
    assert (refused.status_code, refused.json()["code"]) == (429, "too-many-streams")
    assert int(refused.headers["Retry-After"]) >= 1
    streams.pop()[0].close()
    deadline = time.monotonic() + 20
    while (again := opened())[1] != b"200":
        assert time.monotonic() < deadline
        again[0].close()
    for client, _ in [*streams, again]:
        client.close()


def test_events_tell_of_a_cancel(idle, take):
    """The stream opens on the present state and ends with the cancel."""
    identifier = idle.http.post("/v1/segmentations", content=take(310)).json()["id"]
    seen = []
    with idle.http.stream("GET", f"/v1/segmentations/{identifier}/events") as stream:
        for line in stream.iter_lines():
            if line.startswith("data: "):
                seen.append(json.loads(line.removeprefix("data: "))["status"])
                if len(seen) == 1:
                    idle.http.delete(f"/v1/segmentations/{identifier}")
    assert seen == ["queued", "cancelled"]


def test_many_at_once_are_one(service, take):
    """The same new file from eight clients in the same moment: one animation, one segmentation, one result."""
    content = take(311)

    def post(_):
        return httpx.post(f"{service.url}/v1/segmentations", content=content, headers=PREFER, timeout=60)

    with ThreadPoolExecutor(8) as clients:
        answers = list(clients.map(post, range(8)))
    assert {answer.status_code for answer in answers} == {200}
    assert len({answer.text for answer in answers}) == 1
    assert not service.spooled()
