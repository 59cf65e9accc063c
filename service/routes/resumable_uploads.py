"""Uploads that go on where they broke off, by tus 1.0."""

from datetime import UTC, datetime

from anyio import to_thread
from fastapi import APIRouter, Depends, Request, Response
from pydantic import BaseModel, Field

from caesura.service.api_description.media_types import PIECE_TAKEN, UPLOAD_CREATED
from caesura.service.api_description.request_bodies import PIECE_BODY, UPLOAD_HEADERS
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.http.file_name import plain_name
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.segmentations.document_response import document_response
from caesura.service.uploads.body_limit import upload_too_large
from caesura.service.uploads.resumable import completion, tus_headers
from caesura.service.uploads.resumable.upload_records import create_upload
from caesura.worker.records import redis_keys
from caesura.worker.records.record_types import UploadRecord
from caesura.worker.store.disk_space import check_disk_space

router = APIRouter(prefix="/v1/uploads", tags=["uploads"], dependencies=[Depends(tus_headers.require_version)])

PROTOCOL = {"Tus-Resumable": tus_headers.VERSION}


class UploadDocument(BaseModel):
    """An upload that may go on: how much of it has come, and the animation that it is once all has."""

    id: str
    name: str
    offset: int = Field(description="bytes that have come")
    length: int = Field(description="bytes in all")
    expires: datetime = Field(description="until when it is kept")
    animation: str | None = Field(None, description="the animation's id, once all has come")


@router.options("", include_in_schema=False)
@router.options("/{identifier}", include_in_schema=False)
async def describe_protocol(request: Request, backend: BackendDependency) -> Response:
    """Tell the version and the extensions of tus, and how large an upload may be."""
    alone = request.url.path.rstrip("/") == "/v1/uploads"
    headers = {
        "Allow": "OPTIONS, POST" if alone else "DELETE, GET, HEAD, OPTIONS, PATCH",
        "Tus-Version": tus_headers.VERSION,
        "Tus-Extension": tus_headers.EXTENSIONS,
        "Tus-Max-Size": str(backend.settings.max_upload_bytes),
    }
    return Response(status_code=204, headers=headers | PROTOCOL)


@router.post("", status_code=201, response_model=UploadDocument, responses=UPLOAD_CREATED, openapi_extra=UPLOAD_HEADERS)
async def create_resumable_upload(request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Begin an upload that can go on where it breaks off.

    `Upload-Length` says how long the file is; `Upload-Metadata` may hold its `filename`, in base64.
    """
    length = tus_headers.number_header(request, "Upload-Length")
    name = plain_name(tus_headers.metadata_name(request.headers.get("upload-metadata", "")))
    settings = backend.settings
    if length > settings.max_upload_bytes:
        raise upload_too_large(settings.max_upload_bytes, length)
    await to_thread.run_sync(completion.delete_forgotten_uploads, backend)
    settings.scratch_dir.mkdir(parents=True, exist_ok=True)
    await to_thread.run_sync(check_disk_space, settings.scratch_dir, length, settings.min_free_bytes)
    record = await to_thread.run_sync(create_upload, backend.jobs.redis, owner, name, length)
    headers = {"Location": f"/v1/uploads/{record.id}", **_headers(record, 0)}
    return document_response(_document(record, 0), 201, headers)


@router.get("/{identifier}", response_model=UploadDocument)
async def get_resumable_upload(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Tell how much of an upload has come.

    `Upload-Offset` says it too, so that HEAD is enough.
    """
    record = await _owned(backend, identifier, owner)
    offset = await completion.received_bytes(backend, record)
    return document_response(_document(record, offset), 200, _headers(record, offset))


@router.patch("/{identifier}", status_code=204, responses=PIECE_TAKEN, openapi_extra=PIECE_BODY)
async def append_to_upload(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Send the next piece of an upload.

    `Upload-Offset` says where it begins, which must be where the last one ended. With the last piece the file becomes
    an animation: `Content-Location` is its address.
    """
    record = await _owned(backend, identifier, owner)
    tus_headers.check_content_type(request)
    offset = tus_headers.number_header(request, "Upload-Offset")
    if record.animation:
        after, animation = record.length, record.animation
        if offset != record.length:
            raise RequestProblem("wrong-offset", f"All {record.length} bytes have come.", actual=record.length)
    else:
        after, animation = await completion.take_piece(backend, request, record, offset)
    found = {"Content-Location": f"/v1/animations/{animation}"} if animation else {}
    return Response(status_code=204, headers=_headers(record, after) | found)


@router.delete("/{identifier}", status_code=204)
async def delete_resumable_upload(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """End an upload, and delete what has come of it."""
    record = await _owned(backend, identifier, owner)
    await to_thread.run_sync(completion.end_upload, backend, record)
    return Response(status_code=204, headers=PROTOCOL)


async def _owned(backend: Backend, identifier: str, owner: str) -> UploadRecord:
    record = UploadRecord.read(await backend.records.redis.get(redis_keys.upload_key(identifier)))
    if record is None or record.owner != owner:
        raise RequestProblem("not-found", f"There is no upload {identifier}. Its time may be up: begin anew.")
    return record


def _headers(record: UploadRecord, offset: int) -> dict[str, str]:
    lengths = {"Upload-Offset": str(offset), "Upload-Length": str(record.length)}
    return {**PROTOCOL, **lengths, "Upload-Expires": tus_headers.http_date(record.expires), "Cache-Control": "no-store"}


def _document(record: UploadRecord, offset: int) -> UploadDocument:
    return UploadDocument(
        id=record.id,
        name=record.name,
        offset=offset,
        length=record.length,
        expires=datetime.fromtimestamp(record.expires, UTC),
        animation=record.animation or None,
    )
