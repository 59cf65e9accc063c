"""What the OpenAPI description cannot read off the code of answers: every status with its headers and its body."""

from typing import Any

from caesura.formats.exports.export_table import Export, exports_of
from caesura.service.api_description.request_bodies import BYTES
from caesura.service.results.byte_ranges import OCTETS

Answers = dict[int | str, dict[str, Any]]

FILE_TYPES = ("model/gltf-binary", "model/gltf+json", "application/x-npz", "application/zip")


def _reference(model: str) -> dict[str, Any]:
    return {"schema": {"$ref": f"#/components/schemas/{model}"}}


def _json(model: str) -> dict[str, Any]:
    return {"application/json": _reference(model)}


def _files(*kinds: str) -> dict[str, Any]:
    """Octets come first: of several types a generator takes the first that it knows."""
    return {kind: {"schema": BYTES} for kind in (OCTETS, *kinds)}


def _header(description: str) -> dict[str, Any]:
    return {"schema": {"type": "string"}, "description": description}


_LOCATION = {"Location": _header("where it is")}
_AGAIN = {"Location": _header("where to ask again"), "Retry-After": _header("seconds to wait before")}
_TAG = {"ETag": _header("names exactly these bytes, for If-None-Match")}
_UNCHANGED = {"description": "It is the one that the client has.", "headers": _TAG}


def _file_answers(description: str, *kinds: str) -> Answers:
    """A stored file, whole or in part."""
    content = _files(*kinds)
    return {
        200: {"description": description, "headers": _TAG, "content": content},
        206: {"description": "The range of it that was asked for.", "headers": _TAG, "content": content},
        304: _UNCHANGED,
    }


_LATER: Answers = {
    202: {
        "description": "The file is being made; Location says where to ask again.",
        "headers": _AGAIN,
        "content": _json("StatusDocument"),
    }
}

FILE = _file_answers("The bytes.", *FILE_TYPES)
MODEL = _file_answers("The bytes.", "model/gltf-binary")
BLOCKS = _file_answers("The bytes.")
_UNDRAWN: Answers = {204: {"description": "There is none yet."}}

PICTURE_FILE = _file_answers("The picture.", "image/webp", "image/png", "image/jpeg") | _UNDRAWN
PICTURE_SHEET: Answers = {
    206: {"description": "The range of them that was asked for.", "headers": _TAG, "content": _json("Pictures")},
    304: _UNCHANGED,
    **_UNDRAWN,
}
CLIPS = _file_answers("The file with its clips, or a zip of them.", "model/gltf-binary", "application/zip") | _LATER
KEY_POSES = _file_answers("The file with its key poses.", "model/gltf-binary") | _LATER


def _media_type(export: Export) -> dict[str, Any]:
    """The content of an export by its media type."""
    if export.suffix == "json":
        return _json("SegmentationDocument")
    if not export.media_type.startswith("text/"):
        return _files(export.media_type)
    schema = {"schema": {"type": "string"}}
    return {export.media_type: {**schema, "example": export.example} if export.example else schema}


RESULT: Answers = {
    200: {
        "description": "The result.",
        "headers": _TAG,
        "content": {kind: kept for one in exports_of("result").values() for kind, kept in _media_type(one).items()},
    },
    206: {
        "description": "The range of an NPZ that was asked for.",
        "headers": _TAG,
        "content": _files("application/x-npz"),
    },
    304: _UNCHANGED,
    **_LATER,
}


def export_answers(export: Export) -> Answers:
    """The answers of the address of one export."""
    if export.queued:
        return _file_answers(f"{export.title}: {export.description}.", export.media_type) | _LATER
    return {
        200: {
            "description": f"{export.title}: {export.description}.",
            "headers": _TAG,
            "content": _media_type(export),
        },
        304: _UNCHANGED,
    }


UPLOADED: Answers = {
    200: {"description": "It is known already.", "headers": _LOCATION, "content": _json("AnimationDocument")},
    201: {"description": "It is new.", "headers": _LOCATION},
}

_PIECES = {
    "Upload-Offset": _header("bytes that have come"),
    "Upload-Length": _header("bytes in all"),
    "Upload-Expires": _header("until when it is kept"),
}

UPLOAD_CREATED: Answers = {201: {"description": "It has begun.", "headers": {**_LOCATION, **_PIECES}}}

PIECE_TAKEN: Answers = {
    204: {
        "description": "The piece has come.",
        "headers": {**_PIECES, "Content-Location": _header("the animation, once all has come")},
    },
}

REVISED: Answers = {
    201: {
        "description": "Kept. ETag says what the next revision's If-Match must be.",
        "headers": {**_LOCATION, "ETag": _header("the tag of this revision")},
    },
}

REVISION: Answers = {304: _UNCHANGED}

EVENTS: Answers = {
    200: {
        "description": "`status` events; the data of each is a status document.",
        "content": {"text/event-stream": {"schema": {}, "example": 'event: status\ndata: {"id": …}\n'}},
    },
    204: {"description": "It is over, and the client knows (Last-Event-ID)."},
}

SUBMITTED: Answers = {
    200: {
        "description": "Done: the status document holds motions and segments.",
        "headers": _LOCATION,
        "content": _json("StatusDocument"),
    },
    202: {"description": "Queued or running; Location says where to ask again.", "headers": _AGAIN},
}

COLLECTED: Answers = {201: {"description": "Made; its takes are labelled next.", "headers": _LOCATION}}

ADDED: Answers = {202: {"description": "Added; they are labelled next.", "headers": _LOCATION}}

TAKE: Answers = {
    200: {
        "description": "The take. ETag says what the If-Match of a correction is compared with.",
        "headers": {"ETag": _header("the version of the take")},
    }
}

PROPOSED: Answers = {202: {"description": "It is being worked out; Location says where it is.", "headers": _LOCATION}}

SEARCHED: Answers = {202: {"description": "It is being searched; Location says where to ask.", "headers": _LOCATION}}

CANCELLED: Answers = {
    200: {"description": "Cancelled: it was queued or running."},
    204: {"description": "Deleted: it was over."},
}
