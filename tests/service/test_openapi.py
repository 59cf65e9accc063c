"""The OpenAPI document describes every call, with examples that are true to their own schemas."""

import re

import pytest

from caesura.core.segmentation_document import SegmentationDocument
from caesura.service.api_description.openapi import Problem
from caesura.service.app import create_app
from caesura.service.response_documents import AnimationDocument, StatusDocument
from caesura.service.settings import ServiceSettings

MODELS = {"AnimationDocument": AnimationDocument, "StatusDocument": StatusDocument}
MODELS |= {"Problem": Problem, "SegmentationDocument": SegmentationDocument}


@pytest.fixture(scope="module")
def document(tmp_path_factory):
    return create_app(ServiceSettings(data_dir=tmp_path_factory.mktemp("data"))).openapi()


def operations(document):
    return [(f"{m.upper()} {p}", operation) for p, item in document["paths"].items() for m, operation in item.items()]


def references(value):
    """Every $ref in a document."""
    if isinstance(value, dict):
        if isinstance(value.get("$ref"), str):
            yield value["$ref"]
        value = list(value.values())
    if isinstance(value, list):
        for item in value:
            yield from references(item)


def test_it_lists_the_calls_of_the_blueprint(document):
    """All of them, and nothing that is not for clients."""
    listed = {name for name, _ in operations(document)}
    assert {
        "POST /v1/animations", "GET /v1/animations", "GET /v1/animations/{identifier}",
        "GET /v1/animations/{identifier}/file", "DELETE /v1/animations/{identifier}",
        "POST /v1/segmentations", "GET /v1/segmentations", "GET /v1/segmentations/{identifier}",
        "GET /v1/segmentations/{identifier}/events", "DELETE /v1/segmentations/{identifier}",
        "GET /v1/segmentations/{identifier}/result", "GET /v1/segmentations/{identifier}/viewer",
        "GET /v1/methods", "GET /v1/exports", "GET /v1/limits", "GET /healthz", "GET /readyz", "GET /metrics",
    } <= listed  # fmt: skip
    assert "GET /" not in listed


def test_every_reference_leads_somewhere(document):
    """No schema is named that is not there."""
    for reference in references(document):
        place = document
        for step in reference.removeprefix("#/").split("/"):
            place = place[step]


def test_every_call_says_how_it_refuses(document):
    """As a problem document, and never in the framework's own form."""
    for name, operation in operations(document):
        assert "application/problem+json" in operation["responses"]["default"]["content"], name
        assert re.fullmatch(r"[A-Z].{9,79}\.", operation["summary"]), name
        assert operation["description"].replace("\n", " ").startswith(operation["summary"]), name
    assert "HTTPValidationError" not in document["components"]["schemas"]


def test_operation_names_are_unique(document):
    """Client generators make a function of each."""
    names = [operation["operationId"] for _, operation in operations(document)]
    assert len(names) == len(set(names))
    assert {"createSegmentation", "listRevisions", "getResultCsv", "uploadAnimation"} <= set(names)
    assert all(re.fullmatch(r"[a-z]+([A-Z][a-z]+)+", name) for name in names)


def test_every_group_of_calls_is_described(document):
    """And the document says where the service is."""
    used = {tag for _, operation in operations(document) for tag in operation["tags"]}
    assert used == {tag["name"] for tag in document["tags"] if tag["description"]}
    assert document["servers"][0]["url"] == "/"


def test_every_answer_has_its_body(document):
    """All but those that HTTP gives none; files come as bytes for those who know no other type."""
    for name, operation in operations(document):
        for status, answer in operation["responses"].items():
            assert ("content" in answer) == (status not in {"204", "304"}), (name, status)
            binary = {
                kind for kind in answer.get("content", ()) if kind.startswith(("model/", "image/", "application/x"))
            }
            assert not binary or "application/octet-stream" in answer["content"], (name, status)


def test_calls_that_wait_say_so(document):
    """Prefer stands wherever it is heeded."""
    waiting = {
        name for name, call in operations(document) if "Prefer" in {p["name"] for p in call.get("parameters", ())}
    }
    below = "GET /v1/segmentations/{identifier}"
    forms = {f"{below}/result.{form}" for form in ("json", "csv", "npz", "vtt", "eaf")}
    plots = {f"{below}/plot.{form}" for form in ("svg", "png")}
    files = {f"{below}/{form}" for form in ("result", "clips", "keyframes")}
    inside = "GET /v1/collections/{identifier}"
    collections = {inside, f"{inside}/proposals/{{proposal}}", f"{inside}/searches/{{search}}"}
    made = {"POST /v1/segmentations", "POST /v1/segmentations/{identifier}/revisions"}
    assert waiting == made | {below} | forms | plots | files | collections


@pytest.mark.parametrize("name", MODELS)
def test_examples_are_true_to_their_schema(document, name):
    """Each main document has an example, and its model reads it without loss."""
    examples = document["components"]["schemas"][name]["examples"]
    assert examples
    for example in examples:
        read = MODELS[name].model_validate(example).model_dump(mode="json", exclude_unset=True)
        assert read == example


def test_every_parameter_of_the_method_is_documented(document):
    """In the query of the one-curl call, with its unit and its default."""
    from caesura.core.parameters import Parameters

    listed = {p["name"]: p for p in document["paths"]["/v1/segmentations"]["post"]["parameters"]}
    body = document["components"]["schemas"]["SegmentationRequest"]["properties"]
    form = document["components"]["schemas"]["SegmentationForm"]["properties"]
    assert (
        form.keys() - {"file"} == body.keys() - {"animation", "url"} == listed.keys() - {"animation", "Prefer", "url"}
    )
    for name, field in Parameters.model_fields.items():
        assert listed[name]["description"].startswith(f"{field.description}; default: `")
        assert not {"default"} & (listed[name]["schema"].keys() | body[name].keys()), "generated clients would send it"
