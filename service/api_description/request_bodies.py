"""Request bodies, query names and headers that the OpenAPI description cannot read off the code."""

from typing import Any

from caesura.core.parameters import Parameters
from caesura.formats.input_formats import READABLE_FORMATS
from caesura.service.api_description.examples import ANIMATION_ID

BYTES: dict[str, Any] = {"type": "string", "format": "binary"}

_NAME = {"name": {"type": "string", "description": "what to call it"}}

_CALLBACK = {
    "callback_url": {"type": "string", "description": "an address of yours to call once it is over; see the webhooks"}
}

UPLOAD_URL = "an address to fetch the file from, instead of a body; from hosts that the operator lists"

_URL = {"url": {"type": "string", "description": UPLOAD_URL}}

WAIT: dict[str, Any] = {
    "parameters": [
        {
            "name": "Prefer",
            "in": "header",
            "schema": {"type": "string"},
            "description": "`wait=N`: rather wait up to N seconds, at most 30, than ask again",
            "example": "wait=30",
        }
    ]
}
"""The header of every call that waits for a result."""


def parameter_schemas() -> dict[str, dict[str, Any]]:
    """The JSON Schema of each parameter, by its name."""
    schemas: dict[str, dict[str, Any]] = Parameters.model_json_schema()["properties"]
    return schemas


def _without_default(schema: dict[str, Any]) -> dict[str, Any]:
    """A parameter's schema, with its default in words.

    Some generated clients send every default that stands in a schema, and in the query it would collide with the JSON
    body; others want every field that has one. `GET /v1/methods` has the defaults as values.
    """
    plain = {key: value for key, value in schema.items() if key not in {"weight", "title", "default"}}
    return {**plain, "description": f"{schema['description']}; default: `{_shown(schema['default'])}`"}


def _shown(default: Any) -> str:
    return str(default).lower() if isinstance(default, bool) else str(default)


def _query(name: str, schema: dict[str, Any]) -> dict[str, Any]:
    description = schema.get("description", "")
    plain = {key: value for key, value in schema.items() if key != "description"}
    return {"name": name, "in": "query", "schema": plain, "description": description}


_OPTIONAL = {name: _without_default(schema) for name, schema in parameter_schemas().items()}


def _with_enumerated_words(schema: dict[str, Any]) -> dict[str, Any]:
    """The same with `const` as an `enum` of one: openapi-python-client cannot send a `const` in a form."""
    kinds = [
        {"enum": [kind["const"]], "type": "string"} if "const" in kind else kind for kind in schema.get("anyOf", ())
    ]
    return {**schema, "anyOf": kinds} if kinds else schema


def _form(title: str, fields: dict[str, Any]) -> dict[str, Any]:
    """A form of files; its other fields say what the query may say too, but not both."""
    files = {
        "type": "array",
        "items": BYTES,
        "minItems": 1,
        "description": "the file; several, where a .gltf refers to others by name",
    }
    return {"title": title, "type": "object", "required": ["file"], "properties": {"file": files, **_NAME, **fields}}


_FORM_FIELDS = {name: _with_enumerated_words(schema) for name, schema in _OPTIONAL.items()}

SCHEMAS: dict[str, dict[str, Any]] = {
    "SegmentationRequest": {
        "title": "SegmentationRequest",
        "type": "object",
        "properties": {
            "animation": {"type": "string", "description": "an animation's id; it or `url` is needed"},
            **_URL,
            **_NAME,
            **_CALLBACK,
            **_OPTIONAL,
        },
        "additionalProperties": False,
    },
    "SegmentationForm": _form("SegmentationForm", _CALLBACK | _FORM_FIELDS),
    "UploadForm": _form("UploadForm", {}),
    "BatchRequest": {
        "title": "BatchRequest",
        "type": "object",
        "required": ["segmentations"],
        "properties": {
            "segmentations": {
                "type": "array",
                "minItems": 1,
                "maxItems": 100,
                "items": {"$ref": "#/components/schemas/SegmentationRequest"},
            }
        },
        "additionalProperties": False,
    },
    "BatchForm": _form("BatchForm", _CALLBACK | _FORM_FIELDS),
}
"""Bodies by the names that generators give them."""


def _schema(name: str) -> dict[str, Any]:
    return {"schema": {"$ref": f"#/components/schemas/{name}"}}


def _file_content(form: str) -> dict[str, Any]:
    return {"application/octet-stream": {"schema": BYTES}, "multipart/form-data": _schema(form)}


FILE_BODY: dict[str, Any] = {
    "requestBody": {
        "description": f"A file, judged by its first bytes: {READABLE_FORMATS}. Or a form of files.",
        "content": _file_content("UploadForm"),
    }
}

SUBMISSION: dict[str, Any] = {
    "parameters": [
        _query("animation", {"type": "string", "description": "an animation's id, instead of a body"}),
        _query("name", _NAME["name"]),
        _query("callback_url", _CALLBACK["callback_url"]),
        _query("url", _URL["url"]),
        *(_query(name, schema) for name, schema in _OPTIONAL.items()),
        *WAIT["parameters"],
    ],
    "requestBody": {
        "description": "JSON naming an animation with parameters beside it; or the file itself, or a form of files.",
        "content": {
            "application/json": {
                **_schema("SegmentationRequest"),
                "example": {"animation": ANIMATION_ID, "motions": 5},
            },
            **_file_content("SegmentationForm"),
        },
    },
}


BATCH: dict[str, Any] = {
    "parameters": [
        _query("callback_url", _CALLBACK["callback_url"]),
        *(_query(name, schema) for name, schema in _OPTIONAL.items()),
    ],
    "requestBody": {
        "required": True,
        "description": "JSON that lists segmentations of animations; or a form of files, each an animation of its own.",
        "content": {
            "application/json": {
                **_schema("BatchRequest"),
                "example": {"segmentations": [{"animation": ANIMATION_ID, "motions": 5}]},
            },
            "multipart/form-data": _schema("BatchForm"),
        },
    },
}


def _number_header(name: str, description: str) -> dict[str, Any]:
    schema = {"type": "integer", "minimum": 0}
    return {"name": name, "in": "header", "required": True, "schema": schema, "description": description}


UPLOAD_HEADERS: dict[str, Any] = {
    "parameters": [
        _number_header("Upload-Length", "bytes of the file"),
        {
            "name": "Upload-Metadata",
            "in": "header",
            "schema": {"type": "string"},
            "description": "`filename` and its value in base64, as tus has it",
            "example": "filename dGFrZS5nbGI=",
        },
    ]
}

PIECE_BODY: dict[str, Any] = {
    "parameters": [_number_header("Upload-Offset", "where the piece begins")],
    "requestBody": {
        "required": True,
        "description": "The bytes from there on, any number of them; as `application/offset+octet-stream` too.",
        "content": {"application/octet-stream": {"schema": BYTES}},
    },
}

REVISION_BODY: dict[str, Any] = {
    "parameters": [
        {
            "name": "If-Match",
            "in": "header",
            "required": True,
            "schema": {"type": "string"},
            "description": 'the ETag of the revision that was edited, which must be the newest; `"0"` without any',
            "example": '"0"',
        },
        *WAIT["parameters"],
    ],
    "requestBody": {
        "required": True,
        "description": "Segments that tile the take, motions by any numbers, one name for each motion.",
        "content": {"application/json": _schema("RevisionRequest")},
    },
}

PICTURES_BODY: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "description": "One sheet of pictures, eight in a row, and one of them by itself.",
        "content": {"application/json": _schema("Pictures")},
    },
}

TAKE_TAG: dict[str, Any] = {
    "parameters": [
        {
            "name": "If-Match",
            "in": "header",
            "schema": {"type": "string"},
            "description": "the ETag of the take that was corrected; where it has another by now, 412",
            "example": '"1"',
        }
    ]
}
"""The header of corrections of a take in a collection."""
