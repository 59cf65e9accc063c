"""A finished result in the form that was asked for."""

from collections.abc import Callable
from contextlib import aclosing
from dataclasses import dataclass

from anyio import to_thread
from fastapi import Request, Response

from caesura.core.document import SegmentationDocument
from caesura.service.backend import Backend
from caesura.service.documents import StatusDocument
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.problems.status_table import Refusal, problem_response
from caesura.service.results import text_formats
from caesura.service.results.byte_ranges import StoredFile, cache_headers, is_not_modified, stored_response
from caesura.service.results.elan import segments_eaf
from caesura.service.results.result_formats import ResultFormat
from caesura.service.results.revision_request import revised_document, revision_number
from caesura.service.segmentations.status_response import ASK_AGAIN, preference_applied, problem_of, status_response
from caesura.worker.queue.auxiliary_jobs import submit_export
from caesura.worker.records.schema import ExportRecord, SegmentationRecord
from caesura.worker.retention.deletion import delete_result_file
from caesura.worker.store.blobs import BlobMissing

EXPORT_WAIT_SECONDS = 5

WORKER_MADE_FORMATS = {"npz": "result_response", "png": "plot"}
"""Forms that a job makes, for want of arrays or of time here, and what their address calls them."""


Writer = Callable[[SegmentationDocument], str]
TEXT_WRITERS: dict[tuple[str, str], Writer] = {
    ("csv", "segments"): text_formats.segments_csv,
    ("csv", "frames"): text_formats.frames_csv,
    ("vtt", "segments"): text_formats.segments_vtt,
    ("eaf", "segments"): segments_eaf,
    ("svg", "segments"): text_formats.plot_svg,
}


@dataclass(frozen=True)
class RequestedResult:
    """What of a result is asked for: its form, the table of that form, and the revision."""

    form: ResultFormat
    table: str = "segments"
    revision: str = "0"


async def result_response(
    backend: Backend, request: Request, record: SegmentationRecord, wanted: RequestedResult
) -> Response:
    """The result, once there is one; 409 while it is made, its own problem where there will be none."""
    record = await backend.wait_until_settled(record, preferred_wait_seconds(request))
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    number = revision_number(record, wanted.revision)
    if wanted.form.suffix in WORKER_MADE_FORMATS:
        return await _made(backend, request, record, wanted.form, number)
    return await _text(backend, request, record, wanted, number)


def unfinished_response(request: Request, record: SegmentationRecord) -> Response | None:
    """Why there is no result, where there is none."""
    applied = preference_applied(request)
    if record.live:
        detail = f"It is {record.status}. Ask again, send Prefer: wait=30, or follow its events."
        return problem_response({"kind": "request", "code": "not-finished", "detail": detail}, applied)
    return None if record.status == "done" else problem_response(problem_of(record), applied)


async def _text(
    backend: Backend, request: Request, record: SegmentationRecord, wanted: RequestedResult, number: int
) -> Response:
    """Written here, from the stored document."""
    form, table = wanted.form, wanted.table
    write = TEXT_WRITERS.get((form.suffix, table))
    if write is None and (form.suffix, table) != ("json", "segments"):
        raise Refusal("no-such-table", f"{form.suffix} has no table {table!r}; table=frames goes with csv.")
    tag = f"W/{_tag(record, form.suffix, table, str(number))}"
    headers = {**cache_headers(tag), "Vary": "Accept", **preference_applied(request)}
    if is_not_modified(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    content = await _content(backend, record, write, number)
    if form.suffix != "json":
        headers["Content-Disposition"] = f'inline; filename="{record.id}.{form.suffix}"'
    return Response(content, headers=headers, media_type=form.media_type)


async def _content(backend: Backend, record: SegmentationRecord, write: Writer | None, number: int) -> str | bytes:
    """The text; the computed document goes out as it is stored, unread."""
    if write is None and not number:
        stored = await backend.records.document(record.id)
        if stored is None:
            raise Refusal("not-found", f"There is no segmentation {record.id}. It may have been deleted.")
        return stored
    document = await revised_document(backend, record, number)
    return await to_thread.run_sync(write or SegmentationDocument.model_dump_json, document)


async def _made(
    backend: Backend, request: Request, record: SegmentationRecord, form: ResultFormat, number: int
) -> Response:
    """Made of arrays by a job at the first request, then served as stored."""
    query = f"?revision={number}" if number else ""
    here = f"/v1/segmentations/{record.id}/{WORKER_MADE_FORMATS[form.suffix]}.{form.suffix}{query}"
    return await result_file_response(
        backend, request, record, form.suffix + query, here, f"{record.id}.{form.suffix}", form.media_type
    )


async def result_file_response(
    backend: Backend,
    request: Request,
    record: SegmentationRecord,
    form: str,
    here: str,
    name: str,
    media_type: str = "",
) -> Response:
    """A file that a job makes at the first request for it, to be saved as `name`; 202 while it is being made."""
    made = await _export(backend, record.id, form, preferred_wait_seconds(request) or EXPORT_WAIT_SECONDS)
    applied = preference_applied(request)
    if made.problem is not None:
        return problem_response(made.problem, applied)
    size = None if made.key is None else await to_thread.run_sync(_size, backend, record.id, form, made.key)
    if made.key is None or size is None:
        return status_response(StatusDocument.of(record), 202, {"Location": here} | applied | ASK_AGAIN)
    if made.media_type == "application/zip":
        name = name.rpartition(".")[0] + ".zip"
    tag = f'"{made.key.rpartition("/")[2]}"'
    stored = StoredFile(made.key, size, media_type or made.media_type, name, tag)
    return await to_thread.run_sync(stored_response, request, backend.blobs, stored)


async def _export(backend: Backend, identifier: str, form: str, seconds: float) -> ExportRecord:
    """The export, asked for where nobody has yet; as it is after so many seconds."""
    made = await backend.records.export(identifier, form)
    if made is None or made.pending or (made.problem or {}).get("kind") == "worker":
        made = await to_thread.run_sync(submit_export, backend.jobs, identifier, form)
    with backend.limited_wait(seconds):
        async with aclosing(backend.records.changes(identifier)) as changes:
            async for _ in changes:
                made = await backend.records.export(identifier, form) or made
                if not made.pending:
                    return made
    return made


def _size(backend: Backend, identifier: str, form: str, key: str) -> int | None:
    """Bytes of an export; None where it was lost: it is forgotten then, so that it is made again when asked for."""
    try:
        return backend.blobs.size(key)
    except BlobMissing:
        delete_result_file(backend.jobs.records, backend.blobs, identifier, form)
        return None


def _tag(record: SegmentationRecord, *variant: str) -> str:
    """Of exactly this form of exactly this computation: a record that is done is computed anew only as a new one."""
    return f'"{"-".join((record.id, f"{record.created:.6f}", *variant))}"'
