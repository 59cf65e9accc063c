"""The service says what it offers, what it takes, and whether it can work."""

import pytest

from caesura.core.limits import Limits
from caesura.core.registry.methods import METHODS
from caesura.formats.input_formats import INPUT_FORMATS
from tests.service.conftest import UPLOAD_LIMIT


def test_each_method_comes_with_the_schema_of_its_parameters(idle):
    """Name, description, JSON Schema; the default is one of them."""
    answer = idle.http.get("/v1/methods").json()
    names = [method["name"] for method in answer["methods"]]
    assert answer["default"] in names
    assert "joint-entropy" in names
    for method in answer["methods"]:
        assert method["description"]
        assert method["parameters"]["properties"]["method"]["const"] == method["name"]
        needed = "motions" in method["parameters"].get("required", ())
        assert needed == METHODS[method["name"]].needs_motions
        assert needed or method["parameters"]["properties"]["motions"]["default"] == "auto"


def test_each_export_has_an_address_that_openapi_knows(idle):
    """Below the segmentation; titles and descriptions are there for menus."""
    paths = idle.http.get("/openapi.json").json()["paths"]
    exports = idle.http.get("/v1/exports").json()["exports"]
    for export in exports:
        assert f"/v1/segmentations/{{identifier}}/{export['path']}" in paths
        assert export["title"]
        assert export["description"]
    assert len({export["title"] for export in exports}) == len(exports)


def test_each_format_says_what_of_it_is_read(idle):
    """Those of the table, with what must come beside a file; the page lists the same."""
    formats = {one["name"]: one for one in idle.http.get("/v1/formats").json()["formats"]}
    assert formats.keys() == INPUT_FORMATS.keys()
    assert all(one["title"] and one["description"] and one["suffixes"] for one in formats.values())
    assert (formats["pc2"]["suffixes"], formats["pc2"]["companion"]) == ([".pc2"], ".obj")
    assert (formats["glb"]["suffixes"], formats["glb"]["companion"]) == ([".glb", ".vrma"], None)
    page = idle.http.get("/").text
    assert "<code>.pc2</code> with its <code class='beside'>.obj</code>" in page
    assert all(f"<code>{suffix}</code>" in page for one in formats.values() for suffix in one["suffixes"])


def test_limits_are_those_of_this_installation(idle):
    """All of them, with the upload's own."""
    collections = {"max_collection_takes": 1000, "max_collection_seconds": 72_000}
    limits = {**Limits().model_dump(), "max_upload_bytes": UPLOAD_LIMIT, **collections}
    assert idle.http.get("/v1/limits").json() == limits


def test_it_is_alive_and_ready(service):
    """Both probes answer."""
    assert service.http.get("/healthz").json() == {"status": "ok"}
    assert service.http.get("/readyz").json() == {"status": "ready"}


def test_metrics_are_in_prometheus_form(idle):
    """Every line is a comment, or a name and a number."""
    for line in idle.http.get("/metrics").text.splitlines():
        assert line.startswith("# ") or float(line.rsplit(" ", 1)[1]) >= 0


@pytest.mark.parametrize(
    ("method", "path", "status", "code"),
    [
        ("GET", "/nothing", 404, "not-found"),
        ("PUT", "/v1/animations", 405, "method-not-allowed"),
        ("GET", "/v1/limits?x=1", 422, "unknown-parameter"),
        ("GET", "/v1/animations?limit=many", 422, "invalid-parameter"),
        ("GET", "/v1/animations?limit=1000", 422, "invalid-parameter"),
        ("GET", "/v1/segmentations?status=lost", 422, "invalid-parameter"),
        ("GET", "/v1/segmentations?since=yesterday", 422, "invalid-parameter"),
        ("GET", "/v1/segmentations/nothing", 404, "not-found"),
        ("GET", "/v1/segmentations/nothing/result", 404, "not-found"),
        ("DELETE", "/v1/segmentations/nothing", 404, "not-found"),
    ],
)
def test_what_goes_wrong_is_a_problem_document(idle, method, path, status, code):
    """RFC 9457, with a code for programs and a sentence for people."""
    answer = idle.http.request(method, path)
    problem = answer.json()
    assert answer.status_code == problem["status"] == status
    assert answer.headers["Content-Type"] == "application/problem+json"
    assert problem["code"] == code
    assert problem["type"] == f"urn:caesura:problem:{code}"
    assert problem["title"]
    assert problem["detail"].endswith(".")


def test_a_wrong_method_is_told_the_right_ones(idle):
    """Allow, as the header and in the sentence."""
    answer = idle.http.put("/v1/animations")
    assert "POST" in answer.headers["Allow"]
