"""The methods as the API describes them: what each is, and what may be chosen for it."""

from functools import cache
from typing import Any, get_args

from pydantic import BaseModel

from core.parameters import Parameters

DESCRIPTIONS = {
    "switching": "Our default: what every frame does is explained by one of K motions, and changing motion costs.",
    "joint-entropy": "The paper's: key-frames of the joint-entropy curve, grouped by K-means, cuts between groups.",
}


class MethodDocument(BaseModel):
    """A method's name, what it does, and the JSON Schema of its parameters."""

    name: str
    description: str
    parameters: dict[str, Any]


@cache
def methods() -> tuple[MethodDocument, ...]:
    """All methods, in the order in which they are listed."""
    names = get_args(Parameters.model_fields["method"].annotation)
    return tuple(
        MethodDocument(name=name, description=DESCRIPTIONS.get(name, ""), parameters=_schema(name)) for name in names
    )


def _schema(method: str) -> dict[str, Any]:
    """The schema of the parameters with the method settled."""
    schema = Parameters.model_json_schema()
    schema["properties"]["method"] = {"const": method, "description": "the method"}
    return schema
