"""What a submission asks for: which animation, called what, cut how."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

from fastapi import Request

from caesura.core.errors import ParameterError
from caesura.service.http.json_body import read_json_body


@dataclass(frozen=True)
class SegmentationRequest:
    """`animation` is empty where the body is the file itself. `parameters` are as given, not yet checked."""

    animation: str = ""
    name: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def with_fields(self, fields: Mapping[str, str]) -> Self:
        """The same with the fields of a form, which say what the query may say too, but not both."""
        twice = sorted(fields.keys() & self.parameters.keys())
        if twice:
            detail = f"{twice[0]} is given in the form and in the query. Say it once."
            raise ParameterError("repeated-parameter", detail, parameter=twice[0])
        rest = dict(fields)
        name = rest.pop("name", "")
        return replace(self, name=self.name or name, parameters={**self.parameters, **rest})


def request_from_query(query: Mapping[str, str]) -> SegmentationRequest:
    """From the query: `animation` and `name`, and every parameter by its name."""
    return _make_request(dict(query), "")


async def request_from_json(request: Request) -> SegmentationRequest:
    """From a JSON body, with the same names. Raises `Refusal` for what is no JSON object."""
    given = await read_json_body(request, '{"animation": "…", "motions": 5}')
    if request.query_params:
        detail = "Parameters of a JSON call belong into the JSON, not into the query."
        raise ParameterError("misplaced-parameter", detail, parameter=next(iter(request.query_params)))
    if not given.get("animation"):
        detail = 'The JSON must name an animation: {"animation": "…"}. Upload the file first, or send it as the body.'
        raise ParameterError("missing-parameter", detail, parameter="animation", pointer="/animation")
    return _make_request(given, "/")


def _make_request(given: dict[str, Any], pointer: str) -> SegmentationRequest:
    names = {}
    for name in ("animation", "name"):
        value = names[name] = given.pop(name, "")
        if not isinstance(value, str) or len(value) > 1000:
            where = f"{pointer}{name}" if pointer else None
            raise ParameterError("invalid-parameter", f"{name} must be a text.", parameter=name, pointer=where)
    return SegmentationRequest(names["animation"], names["name"], given)
