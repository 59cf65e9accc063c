"""The methods as the API describes them: what each is, and what may be chosen for it."""

from functools import cache
from typing import Any, get_args

from pydantic import BaseModel

from caesura.core.parameters import METHODS_NEEDING_MOTIONS, Parameters

DESCRIPTIONS = {
    "switching": "Our default: what every frame does is explained by one of K motions, and changing motion costs.",
    "joint-entropy": "The paper's: key-frames of the joint-entropy curve, grouped by K-means, cuts between groups.",
    "luo2014": "Compared with: segments in which frames differ least on average, then grouped. Up to 10,000 frames.",
    "spectral": "Compared with: spectral clustering of single frames, no run too short. Up to 5,000 frames.",
    "aca": "Compared with: aligned cluster analysis, groups of segments alike at any speed. Up to 5,000 frames.",
    "haca": "Compared with: aligned cluster analysis in two levels, moves and motions. Up to 5,000 frames.",
}


class MethodDocument(BaseModel):
    """A method's name, what it does, and the JSON Schema of its parameters."""

    name: str
    description: str
    parameters: dict[str, Any]


@cache
def describe_methods() -> tuple[MethodDocument, ...]:
    """All methods, in the order in which they are listed."""
    names = get_args(Parameters.model_fields["method"].annotation)
    return tuple(
        MethodDocument(name=name, description=DESCRIPTIONS.get(name, ""), parameters=_schema(name)) for name in names
    )


def _schema(method: str) -> dict[str, Any]:
    """The schema of the parameters with the method settled; some methods must be told the number of motions."""
    schema = Parameters.model_json_schema()
    schema["properties"]["method"] = {"const": method, "description": "the method"}
    if method in METHODS_NEEDING_MOTIONS:
        motions = schema["properties"]["motions"]
        motions |= {"anyOf": [kind for kind in motions["anyOf"] if kind.get("type") == "integer"]}
        del motions["default"]
        schema["required"] = ["motions"]
    return schema
