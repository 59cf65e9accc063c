"""The methods as the API describes them: what each is, and what may be chosen for it."""

from functools import cache
from typing import Any

from pydantic import BaseModel

from caesura.core.methods.table import METHODS
from caesura.core.parameters import Parameters


class MethodDocument(BaseModel):
    """A method's name, what it does, and the JSON Schema of its parameters."""

    name: str
    description: str
    parameters: dict[str, Any]


@cache
def describe_methods() -> tuple[MethodDocument, ...]:
    """All methods, in the order in which they are listed."""
    return tuple(
        MethodDocument(name=method.name, description=method.description, parameters=_schema(method.name))
        for method in METHODS.values()
    )


def _schema(method: str) -> dict[str, Any]:
    """The schema of the parameters with the method settled; some methods must be told the number of motions."""
    schema = Parameters.model_json_schema()
    schema["properties"]["method"] = {"const": method, "description": "the method"}
    if METHODS[method].needs_motions:
        motions = schema["properties"]["motions"]
        motions |= {"anyOf": [kind for kind in motions["anyOf"] if kind.get("type") == "integer"]}
        del motions["default"]
        schema["required"] = ["motions"]
    return schema
