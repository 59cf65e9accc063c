"""The OpenAPI document: what FastAPI reads off the routes, with problem documents wherever something can go wrong."""

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from fastapi.routing import APIRoute
from pydantic import BaseModel, ConfigDict, Field

from caesura.core.document import SegmentationDocument
from caesura.service.api_description.examples import EXAMPLES, PROBLEM
from caesura.service.problems.status_table import MEDIA_TYPE
from caesura.service.results.revision_request import RevisionRequest

DESCRIPTION = """Finds the motions in a 3D animation: a long take goes in; motions, key-frames and cuts come out.

One call does it all:

    curl --fail -X POST -T take.glb 'localhost:8000/v1/segmentations?motions=5' -H 'Prefer: wait=30'
"""


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
    setting: str | None = Field(None, description="the setting that the keeper of the service may change")


def describe(app: FastAPI) -> None:
    """Have `/openapi.json` answer the whole description."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            app.openapi_schema = _document(app)
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]  # how FastAPI's own documentation extends it


def _document(app: FastAPI) -> dict[str, Any]:
    document = get_openapi(title=app.title, version=app.version, description=DESCRIPTION, routes=app.routes)
    schemas = document["components"]["schemas"]
    template = "#/components/schemas/{model}"
    for model in (Problem, SegmentationDocument, RevisionRequest):
        schema = model.model_json_schema(ref_template=template)
        schemas.update(schema.pop("$defs", {}))
        schemas[model.__name__] = schema
    for name, example in EXAMPLES.items():
        schemas[name]["examples"] = [example]
    refusal = {
        "description": "What is wrong, and what to do about it.",
        "content": {MEDIA_TYPE: {"schema": {"$ref": template.format(model="Problem")}, "example": PROBLEM}},
    }
    document["components"]["securitySchemes"] = {"key": {"type": "http", "scheme": "bearer"}}
    document["security"] = [{"key": []}, {}]  # the second: where the keeper of the service wants none
    for path in document["paths"].values():
        for operation in path.values():
            operation["responses"].pop("422", None)  # FastAPI's own form of a refusal, which is not ours
            operation["responses"]["default"] = refusal
    for unused in ("HTTPValidationError", "ValidationError"):
        schemas.pop(unused, None)
    return document


def operation_name(route: APIRoute) -> str:
    """A call's name for client generators: its noun and its verb."""
    return f"{route.tags[0]}-{route.name}" if route.tags else route.name
