"""JSON as the fuzzer reads it beside glTF: as an order, a revision and a labelling, as far as no server is needed."""

import json
from collections.abc import Coroutine
from typing import Any, TypeVar

from starlette.requests import Request

from caesura.core.errors import CaesuraError
from caesura.core.parameters import Parameters
from caesura.core.revision import check_edits
from caesura.service.commands.frame_labels import Labelling
from caesura.service.results.revision_request import parse_revision_request
from caesura.service.segmentations.segmentation_request import request_from_json

T = TypeVar("T")

SEEDS = (
    {"animation": "abc", "name": "take", "motions": 5, "fps": "30", "trim": True, "start": 0.5, "take": "longest"},
    {"animation": "abc", "method": "joint-entropy", "energy": "joint", "window_seconds": "1.5", "end": "last"},
    {
        "segments": [
            {"start": 0, "end": 30, "motion": 0, "name": "walk", "loop": True},
            {"start": 30, "end": 90, "motion": 1, "name": None, "discard": True},
            {"start": 90, "end": 120, "motion": 0, "name": "walk"},
        ],
        "note": "two names",
    },
    {
        "fps": 30,
        "frames": 90,
        "segments": [{"start": 0, "end": 40, "label": "a"}, {"start": 40, "end": 90, "motion": 1}],
    },
)


def seeds() -> list[bytes]:
    """One body of each kind."""
    return [json.dumps(body).encode() for body in SEEDS]


def attempt_bodies(data: bytes) -> list[CaesuraError]:
    """Read `data` as every body that a client may send; the refusals. Whatever else is raised is a fault of ours."""
    refusals: list[CaesuraError] = []
    for read in (_order, _revision, _labelling):
        try:
            read(data)
        except CaesuraError as refused:
            refusals.append(refused)
    return refusals


def _order(data: bytes) -> None:
    Parameters.parse(_run(request_from_json(_request(data))).parameters)


def _revision(data: bytes) -> None:
    order = _run(parse_revision_request(_request(data)))
    check_edits(order.segments, order.segments[-1].end if order.segments else 0)


def _labelling(data: bytes) -> None:
    try:
        Labelling.of(json.loads(data))
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError):
        return  # as the command has it, which makes a sentence of each


def _run(reading: Coroutine[Any, Any, T]) -> T:
    """What a coroutine returns that waits for nothing; a loop of events would take longer than all the rest."""
    try:
        reading.send(None)
    except StopIteration as done:
        return done.value  # type: ignore[no-any-return]
    raise AssertionError("it waits")


def _request(body: bytes) -> Request:
    async def receive() -> dict[str, Any]:
        return {"type": "http.request", "body": body, "more_body": False}

    headers = [(b"content-type", b"application/json")]
    return Request({"type": "http", "method": "POST", "path": "/", "query_string": b"", "headers": headers}, receive)
