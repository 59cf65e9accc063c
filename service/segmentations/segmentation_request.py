"""A request for a segmentation: its animation, name and parameters."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

from fastapi import Request

from caesura.core.errors import ParameterError
from caesura.service.http.json_body import read_json_body

NAMES = ("animation", "name", "callback_url", "url")
"""What stands beside the parameters."""

LONGEST_TEXT = 2000


@dataclass(frozen=True)
class SegmentationRequest:
    """`animation` is empty where the body is the file itself, or it is fetched from `url`.

    `parameters` are as given, not yet checked. `callback_url` is the address to call once it is over.
    """

    animation: str = ""
    name: str = ""
    callback_url: str = ""
    url: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def with_fields(self, fields: Mapping[str, str]) -> Self:
        """The same with the fields of a form, which say what the query may say too, but not both."""
        twice = sorted(fields.keys() & self.parameters.keys())
        if twice:
            detail = f"{twice[0]} is given in the form and in the query. Give it once."
            raise ParameterError("repeated-parameter", detail, parameter=twice[0])
        rest = dict(fields)
        name, callback_url = rest.pop("name", ""), rest.pop("callback_url", "")
        return replace(
            self,
            name=self.name or name,
            callback_url=self.callback_url or callback_url,
            parameters={**self.parameters, **rest},
        )


def request_from_query(query: Mapping[str, str]) -> SegmentationRequest:
    """From the query: `animation` and `name`, and every parameter by its name."""
    return _make_request(dict(query), "")


async def request_from_json(request: Request) -> SegmentationRequest:
    """From a JSON body, with the same names. Raises `RequestProblem` for what is no JSON object."""
    given = await read_json_body(request, '{"animation": "…", "motions": 5}')
    if request.query_params:
        detail = "Parameters of a JSON request belong in the JSON, not in the query."
        raise ParameterError("misplaced-parameter", detail, parameter=next(iter(request.query_params)))
    if not given.get("animation") and not given.get("url"):
        detail = 'The JSON must name an animation: {"animation": "…"}. Upload the file first, or send it as the body.'
        raise ParameterError("missing-parameter", detail, parameter="animation", pointer="/animation")
    return _make_request(given, "/")


def request_from_batch_item(given: dict[str, Any]) -> SegmentationRequest:
    """From one item of a batch, with the same names."""
    return _make_request(given, "/")


def _make_request(given: dict[str, Any], pointer: str) -> SegmentationRequest:
    names = {}
    for name in NAMES:
        value = names[name] = given.pop(name, "")
        if not isinstance(value, str) or len(value) > LONGEST_TEXT:
            where = f"{pointer}{name}" if pointer else None
            raise ParameterError("invalid-parameter", f"{name} must be a text.", parameter=name, pointer=where)
    return SegmentationRequest(**names, parameters=given)
