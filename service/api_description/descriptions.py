"""What the OpenAPI description cannot read off the code: raw bodies, query names of parameters, media types."""

from typing import Any

from caesura.core.parameters import Parameters
from caesura.service.api_description.examples import ANIMATION_ID
from caesura.service.results.result_formats import RESULT_FORMATS

_BYTES: dict[str, Any] = {"type": "string", "format": "binary"}
_FORM: dict[str, Any] = {
    "type": "object",
    "properties": {
        "file": {**_BYTES, "description": "the file; several, where a .gltf refers to others by name"},
        "name": {"type": "string", "description": "what to call it"},
    },
}

FILE_BODY: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "description": "A .glb, .gltf, .bvh, .npz or .zip, judged by its first bytes, or a form of files.",
        "content": {"application/octet-stream": {"schema": _BYTES}, "multipart/form-data": {"schema": _FORM}},
    }
}

FILE_TYPES = (
    "application/octet-stream", "model/gltf-binary", "model/gltf+json", "application/x-npz", "application/zip"
)  # fmt: skip

FILE: dict[int | str, dict[str, Any]] = {
    200: {"description": "The bytes.", "content": {kind: {"schema": _BYTES} for kind in FILE_TYPES}},
    206: {"description": "The range of them that was asked for."},
    304: {"description": "They are those that the client has."},
}

RESULT: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The result.",
        "content": {
            "application/json": {"schema": {"$ref": "#/components/schemas/SegmentationDocument"}},
            "text/csv": {
                "schema": {"type": "string"},
                "example": "name,motion,start,end,start_seconds,end_seconds,confidence,loop,discard\n"
                "A,0,0,205,0.000000,6.833333,0.91,0,0\n",
            },
            "text/vtt": {
                "schema": {"type": "string"},
                "example": "WEBVTT\n\n00:00:00.000 --> 00:00:06.833\nA\n",
            },
            "text/x-eaf+xml": {"schema": {"type": "string"}},
            RESULT_FORMATS[2].media_type: {"schema": _BYTES},
        },
    },
    202: {"description": "The file is being made; ask again."},
    304: {"description": "It is the one that the client has."},
}

PLOT: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The picture.",
        "content": {"image/svg+xml": {"schema": {"type": "string"}}, "image/png": {"schema": _BYTES}},
    },
    202: {"description": "The picture is being drawn; ask again."},
    304: {"description": "It is the one that the client has."},
}

_LATER: dict[int | str, dict[str, Any]] = {
    202: {"description": "The file is being made; Location says where to ask again."},
    206: {"description": "The range of it that was asked for."},
    304: {"description": "It is the one that the client has."},
}

CLIPS: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The file with its clips, or a zip of them.",
        "content": {"model/gltf-binary": {"schema": _BYTES}, "application/zip": {"schema": _BYTES}},
    },
    **_LATER,
}

KEY_POSES: dict[int | str, dict[str, Any]] = {
    200: {"description": "The file with its key poses.", "content": {"model/gltf-binary": {"schema": _BYTES}}},
    **_LATER,
}

_EVENT: dict[str, Any] = {
    "type": "object",
    "properties": {name: {"type": "string"} for name in ("event", "id", "data")},
    "description": "one event; its data is a status document as text",
}

REVISED: dict[int | str, dict[str, Any]] = {
    201: {"description": "Kept. Location says where, ETag what the next revision's If-Match must be."},
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
        }
    ],
    "requestBody": {
        "required": True,
        "description": "Segments that tile the take, motions by any numbers, one name for each motion.",
        "content": {"application/json": {"schema": {"$ref": "#/components/schemas/RevisionRequest"}}},
    },
}

EVENTS: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "`status` events, each a status document.",
        "content": {"text/event-stream": {"schema": _EVENT, "example": 'event: status\ndata: {"id": …}\n'}},
    },
    204: {"description": "It is over, and the client knows (Last-Event-ID)."},
}

SUBMITTED: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "Done: the status document holds motions and segments.",
        "content": {"application/json": {"schema": {"$ref": "#/components/schemas/StatusDocument"}}},
    },
    202: {"description": "Queued or running; Location says where to ask again."},
}

WAIT: dict[str, Any] = {
    "name": "Prefer",
    "in": "header",
    "schema": {"type": "string"},
    "description": "`wait=N`: rather wait up to N seconds, at most 30, than ask again",
    "example": "wait=30",
}


def parameter_schemas() -> dict[str, dict[str, Any]]:
    """The JSON Schema of each parameter, by its name."""
    schemas: dict[str, dict[str, Any]] = Parameters.model_json_schema()["properties"]
    return schemas


def _query(name: str, schema: dict[str, Any]) -> dict[str, Any]:
    plain = {key: value for key, value in schema.items() if key not in {"weight", "description", "title"}}
    return {"name": name, "in": "query", "schema": plain, "description": schema.get("description", "")}


SUBMISSION: dict[str, Any] = {
    "parameters": [
        _query("animation", {"type": "string", "description": "an animation's id, instead of a body"}),
        _query("name", {"type": "string", "description": "what to call it"}),
        *(_query(name, schema) for name, schema in parameter_schemas().items()),
        WAIT,
    ],
    "requestBody": {
        "description": "JSON naming an animation with parameters beside it; or the file itself, or a form of files.",
        "content": {
            "application/json": {
                "schema": {
                    "type": "object",
                    "required": ["animation"],
                    "properties": {
                        "animation": {"type": "string"},
                        "name": {"type": "string"},
                        **parameter_schemas(),
                    },
                    "additionalProperties": False,
                },
                "example": {"animation": ANIMATION_ID, "motions": 5},
            },
            **FILE_BODY["requestBody"]["content"],
        },
    },
}
