"""The OpenAPI document describes every call, with examples that are true to their own schemas."""

import pytest

from caesura.core.document import SegmentationDocument
from caesura.service.api_description.openapi import Problem
from caesura.service.app import create_app
from caesura.service.documents import AnimationDocument, StatusDocument
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
        assert operation["summary"], name
        assert operation["description"], name
    assert "HTTPValidationError" not in document["components"]["schemas"]


def test_operation_names_are_unique(document):
    """Client generators make a function of each."""
    names = [operation["operationId"] for _, operation in operations(document)]
    assert len(names) == len(set(names))


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
    for name, field in Parameters.model_fields.items():
        assert listed[name]["description"] == field.description
        assert listed[name]["schema"]["default"] == field.default
