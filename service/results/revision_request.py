"""The revision of a result that a request names, and the body that makes a new one."""

import re
from typing import Annotated

from anyio import to_thread
from fastapi import Query, Request
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from caesura.core.errors import ParameterError
from caesura.core.revision import Edit, apply_revision
from caesura.core.segmentation_document import Loop, SegmentationDocument
from caesura.service.backend import Backend
from caesura.service.http.json_body import read_json_body
from caesura.service.problems.problem_response import RequestProblem
from caesura.worker.records.record_types import SegmentationRecord
from caesura.worker.records.revisions import MOST_REVISIONS, Revisions

LONGEST_NOTE = 500
LONGEST_POINTER = 200

WHICH = "which revision: 0 is the result as computed, `latest` the newest"

Revision = Annotated[str, Query(description=WHICH)]


class RevisionRequest(BaseModel):
    """A revision to be: the segments of the whole take in order, and what to say about it."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    segments: list[Edit] = Field(description="they tile the take: each begins where the one before ends")
    note: str = Field("", max_length=LONGEST_NOTE, description="a line about what was changed")


def revision_number(record: SegmentationRecord, revision: str) -> int:
    """The number that `revision` means: 0, a number, or `latest`.

    Raises `ParameterError` for another word, `RequestProblem` ("not-found") for a revision that there is not.
    """
    if revision == "latest":
        return record.revision
    if not re.fullmatch(r"[0-9]{1,6}", revision):
        detail = f"revision = {revision[:50]!r} is not possible. It is a number, or `latest`."
        raise ParameterError("invalid-parameter", detail, parameter="revision")
    if int(revision) > record.revision:
        detail = f"There is no revision {int(revision)}. The newest is {record.revision}; 0 is the result as computed."
        raise RequestProblem("not-found", detail)
    return int(revision)


def expected_revision(request: Request) -> int | None:
    """The revision that the client has edited, as If-Match says; None for `*`, whichever that is.

    Raises `RequestProblem` where it says nothing (428), or what is no tag of a revision (412).
    """
    header = request.headers.get("if-match", "").strip()
    if not header:
        detail = 'Say which revision was edited: send its ETag as If-Match, `If-Match: "0"` for the computed result.'
        raise RequestProblem("no-if-match", detail)
    if header == "*":
        return None
    tag = re.fullmatch(r'"([0-9]{1,6})"', header)
    if tag is None:
        raise RequestProblem(
            "stale-revision", 'If-Match is no tag of a revision. It is such as "0": a number in quotes.'
        )
    return int(tag[1])


async def parse_revision_request(request: Request) -> RevisionRequest:
    """The body, shaped as it must be; raises `ParameterError` with a pointer to the first fault."""
    given = await read_json_body(request, '{"segments": […], "note": ""}')
    try:
        order = RevisionRequest.model_validate(given)
    except ValidationError as refused:
        first = refused.errors(include_url=False, include_context=False, include_input=False)[0]
        pointer = "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in first["loc"])
        detail = f"{first['msg']}: {pointer[:LONGEST_POINTER]}."
        raise ParameterError("invalid-parameter", detail, pointer=pointer[:LONGEST_POINTER]) from None
    if not order.note.isprintable():
        raise ParameterError("invalid-parameter", "The note must be one line of text.", pointer="/note")
    return order


def refuse_stale_revision(record: SegmentationRecord) -> RequestProblem:
    """Why a revision was not kept."""
    if record.revision >= MOST_REVISIONS:
        detail = (
            f"The result has {MOST_REVISIONS} revisions, which is the limit. Segment the take again to edit further."
        )
        return RequestProblem("too-many-revisions", detail, limit=MOST_REVISIONS)
    detail = f"Another person saved revision {record.revision} first. Load it, then edit again."
    return RequestProblem("stale-revision", detail, current=record.revision)


async def revised_document(backend: Backend, record: SegmentationRecord, number: int) -> SegmentationDocument:
    """The result as it reads with that revision; raises `RequestProblem` where it was deleted meanwhile."""
    stored = await backend.records.document(record.id)
    revisions = Revisions(backend.records)
    kept = await revisions.one(record.id, number) if number else None
    loops = await revisions.loops(record.id, number) if number else None
    if stored is None or (number and kept is None):
        raise RequestProblem("not-found", f"There is no segmentation {record.id}. It may have been deleted.")
    return await to_thread.run_sync(_read, stored, number, kept[1] if kept else None, loops)


def _read(
    stored: bytes | str, number: int, edits: tuple[Edit, ...] | None, loops: tuple[Loop | None, ...] | None
) -> SegmentationDocument:
    document = SegmentationDocument.model_validate_json(stored)
    return document if edits is None else apply_revision(document, number, edits, loops)
