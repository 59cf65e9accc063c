"""A finished result in the format that the request asks for."""

from contextlib import aclosing
from dataclasses import dataclass
from pathlib import PurePath

from anyio import to_thread
from fastapi import Request, Response

from caesura.formats.exports.export_table import Export
from caesura.service.backend import Backend
from caesura.service.http.file_name import plain_name
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.problems.problem_response import RequestProblem, problem_response
from caesura.service.response_documents import StatusDocument
from caesura.service.results.byte_ranges import (
    StoredFile,
    accepted_type,
    cache_headers,
    content_disposition,
    is_not_modified,
    stored_response,
)
from caesura.service.results.result_formats import export_by_table
from caesura.service.results.revision_request import revised_document, revision_number
from caesura.service.segmentations.document_response import ASK_AGAIN, document_response, preference_applied, problem_of
from caesura.worker.queue.auxiliary_jobs import submit_export
from caesura.worker.records.record_types import ExportRecord, SegmentationRecord
from caesura.worker.retention.deletion import delete_result_file
from caesura.worker.store.blobs import BlobMissing

EXPORT_WAIT_SECONDS = 5


@dataclass(frozen=True)
class RequestedResult:
    """What of a result is asked for: the file, the table in it, and the revision."""

    export: Export
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
    if wanted.export.queued:
        return await _job_made_response(backend, request, record, wanted.export, number)
    return await _text(backend, request, record, export_by_table(wanted.export, wanted.table), number)


async def download_stem(backend: Backend, record: SegmentationRecord) -> str:
    """What the files of a result are called before their endings: as the animation, and the take of several.

    As the segmentation where the animation was deleted meanwhile.
    """
    animation = await backend.records.owned_animation(record.animation, record.owner)
    stem = PurePath(record.name or (animation.name if animation else "")).stem or record.id
    if animation is None or animation.take_count < 2:
        return stem
    chosen = record.parameters["take"]
    names = [take.name for take in await backend.records.takes(animation) if take.index == chosen]
    return f"{stem}-{plain_name(names[0]) or chosen}" if names else stem


def unfinished_response(request: Request, record: SegmentationRecord) -> Response | None:
    """Why there is no result, where there is none."""
    applied = preference_applied(request)
    if record.live:
        detail = f"The segmentation is {record.status}. Ask again, send Prefer: wait=30, or follow its events."
        return problem_response({"kind": "request", "code": "not-finished", "detail": detail}, applied)
    return None if record.status == "done" else problem_response(problem_of(record), applied)


async def _text(
    backend: Backend, request: Request, record: SegmentationRecord, export: Export, number: int
) -> Response:
    """Written here, from the stored document."""
    tag = f"W/{_tag(record, export.suffix, export.table, str(number))}"
    headers = {**cache_headers(tag), "Vary": "Accept", **preference_applied(request)}
    if is_not_modified(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    content = await _content(backend, record, export, number)
    name = await download_stem(backend, record) + export.file_ending(export.media_type)
    headers["Content-Disposition"] = content_disposition(name, "inline")
    return Response(content, headers=headers, media_type=accepted_type(request, export.media_type))


async def _content(backend: Backend, record: SegmentationRecord, export: Export, number: int) -> str | bytes:
    """The text; the computed document goes out as it is stored, unread."""
    if export.suffix == "json" and not number:
        stored = await backend.records.document(record.id)
        if stored is None:
            raise RequestProblem("not-found", f"There is no segmentation {record.id}. It may have been deleted.")
        return stored
    document = await revised_document(backend, record, number)
    return await to_thread.run_sync(export.text, document)


async def _job_made_response(
    backend: Backend, request: Request, record: SegmentationRecord, export: Export, number: int
) -> Response:
    """Made of arrays by a job at the first request, then served as stored."""
    query = f"?revision={number}" if number else ""
    here = f"/v1/segmentations/{record.id}/{export.path}{query}"
    name = await download_stem(backend, record) + export.file_ending(export.media_type)
    return await result_file_response(backend, request, record, export.suffix + query, here, name, export.media_type)


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
        return document_response(StatusDocument.of(record), 202, {"Location": here} | applied | ASK_AGAIN)
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
        async with aclosing(backend.records.follow_changes(identifier)) as changes:
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
