"""Every address answers every method as HTTP has it: HEAD wherever GET is, and `Allow` that is true."""

import re
import time

import pytest

from tests.service.test_openapi import document as document  # noqa: PLC0414  the fixture

METHODS = ("GET", "HEAD", "OPTIONS", "POST", "DELETE")
HERE = "/v1/segmentations/nothing"
THERE = "/v1/collections/nothing"

STATUSES = {
    "/": (200, 200, 204, 405, 405),
    "/docs": (200, 200, 204, 405, 405),
    "/openapi.json": (200, 200, 204, 405, 405),
    "/static/icon.svg": (200, 200, 204, 405, 405),
    "/nothing": (404, 404, 404, 404, 404),
    "/healthz": (200, 200, 204, 405, 405),
    "/readyz": (503, 503, 204, 405, 405),
    "/metrics": (200, 200, 204, 405, 405),
    "/v1/methods": (200, 200, 204, 405, 405),
    "/v1/exports": (200, 200, 204, 405, 405),
    "/v1/formats": (200, 200, 204, 405, 405),
    "/v1/limits": (200, 200, 204, 405, 405),
    "/v1/session": (405, 405, 204, 422, 204),
    "/v1/callbacks/secret": (200, 200, 204, 405, 405),
    "/v1/batches": (405, 405, 204, 200, 405),
    "/v1/uploads": (405, 405, 204, 422, 405),
    "/v1/uploads/nothing": (404, 404, 204, 405, 404),
    "/v1/animations": (200, 200, 204, 415, 405),
    "/v1/animations/nothing": (404, 404, 204, 405, 404),
    "/v1/animations/nothing/file": (404, 404, 204, 405, 405),
    "/v1/segmentations": (200, 200, 204, 415, 405),
    HERE: (404, 404, 204, 405, 404),
    f"{HERE}/events": (404, 404, 204, 405, 405),
    f"{HERE}/result": (404, 404, 204, 405, 405),
    f"{HERE}/result.json": (404, 404, 204, 405, 405),
    f"{HERE}/result.csv": (404, 404, 204, 405, 405),
    f"{HERE}/result.npz": (404, 404, 204, 405, 405),
    f"{HERE}/result.vtt": (404, 404, 204, 405, 405),
    f"{HERE}/result.eaf": (404, 404, 204, 405, 405),
    f"{HERE}/plot.svg": (404, 404, 204, 405, 405),
    f"{HERE}/plot.png": (404, 404, 204, 405, 405),
    f"{HERE}/viewer": (404, 404, 204, 405, 405),
    f"{HERE}/viewer/model": (404, 404, 204, 405, 405),
    f"{HERE}/viewer/strain": (404, 404, 204, 405, 405),
    f"{HERE}/viewer/materials": (404, 404, 204, 405, 405),
    f"{HERE}/clips": (404, 404, 204, 405, 405),
    f"{HERE}/clips/plan": (404, 404, 204, 405, 405),
    f"{HERE}/pictures": (404, 404, 204, 405, 405),
    f"{HERE}/poster": (404, 404, 204, 405, 405),
    f"{HERE}/keyframes": (404, 404, 204, 405, 405),
    f"{HERE}/revisions": (404, 404, 204, 404, 405),
    f"{HERE}/revisions/1": (404, 404, 204, 405, 405),
    "/v1/collections": (200, 200, 204, 422, 405),
    THERE: (404, 404, 204, 405, 404),
    f"{THERE}/takes": (404, 404, 204, 422, 405),
    f"{THERE}/takes/nothing": (404, 404, 204, 405, 404),
    f"{THERE}/motions/nothing": (405, 405, 204, 405, 405),
    f"{THERE}/proposals": (404, 404, 204, 422, 405),
    f"{THERE}/proposals/nothing": (404, 404, 204, 405, 405),
    f"{THERE}/searches": (405, 405, 204, 422, 405),
    f"{THERE}/searches/nothing": (404, 404, 204, 405, 405),
}
"""What a service without workers answers to each method without a body."""


def test_the_table_has_every_address(document):
    """Of the OpenAPI document, and those of the page."""
    named = (path.replace("{revision}", "1") for path in document["paths"])
    described = {re.sub(r"\{\w+\}", "nothing", path) for path in named}
    assert described <= STATUSES.keys()


@pytest.mark.parametrize("path", STATUSES)
def test_each_method_has_its_status(idle, path):
    """HEAD is answered as GET is; what is not possible says what is."""
    answers = [idle.http.request(method, path) for method in METHODS]
    assert tuple(answer.status_code for answer in answers) == STATUSES[path]
    head, options = answers[1], answers[2]
    assert not head.content
    for answer in answers:
        if answer.status_code == 405 or (answer is options and path != "/nothing"):
            allow = answer.headers["Allow"].split(", ")
            assert allow == sorted(allow)
            assert {"OPTIONS"} < set(allow)
            assert {m for m, other in zip(METHODS, answers, strict=True) if other.status_code != 405} <= {
                *allow,
                "PATCH",
            }
            assert answer.request.method not in allow or answer is options
            assert ("GET" in allow) == ("HEAD" in allow)


def test_allow_names_every_method_of_an_address(idle):
    """Whichever of its calls was found first."""
    assert idle.http.put("/v1/animations").headers["Allow"] == "GET, HEAD, OPTIONS, POST"
    assert idle.http.options("/v1/animations/x").headers["Allow"] == "DELETE, GET, HEAD, OPTIONS, PATCH"


@pytest.fixture(scope="module")
def address(service, take):
    answer = service.http.post("/v1/segmentations?motions=3", content=take(4711), headers={"Prefer": "wait=30"})
    assert answer.json()["status"] == "done"
    return answer.json()["links"]["self"]


@pytest.mark.parametrize("encoding", ["identity", "gzip", "zstd"])
@pytest.mark.parametrize("path", ["", "/result", "/result.csv", "/plot.svg", "/viewer/model", "/viewer/strain"])
def test_head_has_the_headers_of_get(service, address, path, encoding):
    """Its length included, though nothing follows."""
    asked = {"Accept-Encoding": encoding}
    get = service.http.get(address + path, headers=asked)
    head = service.http.head(address + path, headers=asked)
    varying = {"date", "x-request-id", "transfer-encoding"}
    described = [{k: v for k, v in one.headers.items() if k not in varying} for one in (get, head)]
    assert described[0] == described[1]
    assert get.content
    assert not head.content


def test_head_of_an_event_stream_ends_at_once(idle, take):
    """Though the segmentation never does."""
    made = idle.http.post("/v1/segmentations", content=take(4712)).json()
    began = time.monotonic()
    head = idle.http.head(made["links"]["events"])
    assert head.headers["Content-Type"].startswith("text/event-stream")
    assert time.monotonic() - began < 3
    idle.http.delete(made["links"]["self"])
