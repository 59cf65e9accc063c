"""Requests made of the OpenAPI document, right ones and wrong ones, to the running service (schemathesis)."""

import os
import random
import time

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)

START_SECONDS = 120
"""What the first job of a machine may take: its loops are compiled then."""

RIGHT, WRONG = (int(count) for count in os.environ.get("FUZZ_REQUESTS", "4,2").split(","))
"""Requests of each call that keep to the description, and that do not; `make fuzz` makes more."""

SAID_OF_TEXT = {"type", "title", "description", "default"}
"""What does not narrow a string."""

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
]


@pytest.fixture(scope="module")
def operations(service):
    """Every call that the running service describes."""
    schema = schemathesis.openapi.from_url(f"{service.url}/openapi.json")
    return [found.ok() for found in schema.get_all_operations()]


@pytest.fixture(scope="module")
def kept(service, take):
    """What there is to ask for: an animation and its segmentation, done."""
    answer = service.http.post("/v1/segmentations?motions=3", content=take(777))
    deadline = time.monotonic() + START_SECONDS
    while answer.json()["status"] != "done":
        assert time.monotonic() < deadline
        answer = service.http.get(answer.json()["links"]["self"], headers={"Prefer": "wait=30"})
    return {"animations": answer.json()["animation"], "segmentations": answer.json()["id"]}


@pytest.mark.parametrize(
    ("mode", "examples"), [(GenerationMode.POSITIVE, RIGHT), (GenerationMode.NEGATIVE, WRONG)], ids=["right", "wrong"]
)
def test_every_call_keeps_to_its_description(operations, kept, subtests, mode, examples):
    """No 5xx; answers of the kind, with the headers and of the shape that the document says. The same each time."""
    asked = operations if mode is GenerationMode.POSITIVE else list(filter(_can_be_asked_wrongly, operations))
    assert len(asked) > 25
    for operation in asked:
        with subtests.test(operation.label):
            _ask(operation, kept, mode, examples)


def _can_be_asked_wrongly(operation):
    """Not if all that it takes is free text, such as an identifier."""
    schemas = (parameter.definition["schema"] for parameter in operation.iter_parameters())
    return bool(operation.body) or any(schema.keys() - SAID_OF_TEXT or schema["type"] != "string" for schema in schemas)


def _ask(operation, kept, mode, examples):
    odd = random.Random(operation.label)

    @settings(
        max_examples=examples,
        derandomize=True,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(case=operation.as_strategy(generation_mode=mode))
    def ask(case):
        collection = operation.path.split("/")[2:3]
        if collection and collection[0] in kept and case.method != "DELETE" and odd.random() < 0.7:
            case.path_parameters["identifier"] = kept[collection[0]]
        case.call_and_validate(checks=CHECKS, timeout=30)

    ask()
