"""The OpenAPI document: what FastAPI reads off the routes, with problem documents wherever something can go wrong."""

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from fastapi.routing import APIRoute
from pydantic import BaseModel, ConfigDict, Field

from caesura.core.segmentation_document import SegmentationDocument
from caesura.service.api_description.examples import EXAMPLES, PROBLEM
from caesura.service.api_description.request_bodies import SCHEMAS
from caesura.service.problems.problem_response import MEDIA_TYPE
from caesura.service.results.revision_request import RevisionRequest

DESCRIPTION = """Finds the motions in a 3D animation: a long take goes in; motions, key-frames and cuts come out.

One call does it all:

    curl --fail -X POST -T take.glb 'localhost:8000/v1/segmentations?motions=5&name=take.glb' -H 'Prefer: wait=30'
"""


TAGS = {
    "animations": "Uploaded files.",
    "uploads": "Uploads that go on where they broke off, by tus 1.0.",
    "segmentations": "Requests to find the motions of an animation, and how far they are.",
    "results": "A finished result in every form, and what the page plays.",
    "revisions": "Segments that a person edited, kept beside the computed ones.",
    "clips": "The uploaded file again, with its motions as clips or with its key poses alone.",
    "collections": "Many takes in the same motions: named once, corrected, searched by example.",
    "callbacks": "Webhooks: calls to an address of yours, once a segmentation is over.",
    "session": "Sign-in of a browser, where the service wants keys.",
    "about": "What the service offers, and its limits.",
    "health": "Probes and metrics.",
}
"""What each group of calls is for."""


class Problem(BaseModel):
    """What is wrong, for programs (`code`) and for people (`detail`), and where (RFC 9457)."""

    model_config = ConfigDict(extra="allow")

    type: str
    title: str
    status: int
    detail: str
    code: str
    kind: str
    pointer: str | None = Field(None, description="JSON pointer into the file or the body")
    parameter: str | None = None
    limit: float | None = None
    actual: float | None = None
    setting: str | None = Field(None, description="the setting that the operator of the service may change")


def install_description(app: FastAPI) -> None:
    """Have `/openapi.json` answer the whole description."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            app.openapi_schema = _document(app)
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]  # how FastAPI's own documentation extends it


def _document(app: FastAPI) -> dict[str, Any]:
    document = get_openapi(
        title=app.title,
        version=app.version,
        description=DESCRIPTION,
        routes=app.routes,
        tags=[{"name": name, "description": description} for name, description in TAGS.items()],
        servers=[{"url": "/", "description": "the service that answers with this document"}],
    )
    schemas = document["components"]["schemas"]
    template = "#/components/schemas/{model}"
    for model in (Problem, SegmentationDocument, RevisionRequest):
        schema = model.model_json_schema(ref_template=template)
        schemas.update(schema.pop("$defs", {}))
        schemas[model.__name__] = schema
    schemas.update(SCHEMAS)
    for name in ("RevisionRequest", "Edit"):  # of requests alone: a default would have clients ask for the field
        for field in schemas[name]["properties"].values():
            field.pop("default", None)
    for name, example in EXAMPLES.items():
        schemas[name]["examples"] = [example]
    refusal = {
        "description": "What is wrong, and what to do about it.",
        "content": {MEDIA_TYPE: {"schema": {"$ref": template.format(model="Problem")}, "example": PROBLEM}},
    }
    document["components"]["securitySchemes"] = {"key": {"type": "http", "scheme": "bearer"}}
    document["security"] = [{"key": []}, {}]  # the second: where the operator of the service wants none
    for path in document["paths"].values():
        for operation in path.values():
            operation["responses"].pop("422", None)  # FastAPI's own form of a refusal, which is not ours
            operation["responses"]["default"] = refusal
            operation["summary"] = operation["description"].partition("\n\n")[0].replace("\n", " ")
    for unused in ("HTTPValidationError", "ValidationError"):
        schemas.pop(unused, None)
    return document


def operation_name(route: APIRoute) -> str:
    """A call's name for client generators: its verb and its noun, such as `createSegmentation`."""
    verb, *rest = route.name.split("_")
    return verb + "".join(word.capitalize() for word in rest)
