"""Uploaded files."""

from typing import Annotated

from anyio import to_thread
from fastapi import APIRouter, Query, Request, Response

from caesura.service.api_description.descriptions import FILE, FILE_BODY
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.documents import AnimationDocument, AnimationPage, AnimationSummary
from caesura.service.http.paging import Cursor, Limit, decode_cursor, encode_cursor
from caesura.service.problems.status_table import Refusal
from caesura.service.results.byte_ranges import StoredFile, stored_response
from caesura.service.segmentations.status_response import status_response
from caesura.service.uploads.registration import register_upload
from caesura.service.uploads.upload_body import receive_upload
from caesura.worker.records.schema import AnimationRecord
from caesura.worker.retention.deletion import delete_animation

MEDIA_TYPES = {
    "glb": "model/gltf-binary",
    "gltf": "model/gltf+json",
    "npz": "application/x-npz",
    "zip": "application/zip",
}

router = APIRouter(prefix="/v1/animations", tags=["animations"])


@router.post("", status_code=201, response_model=AnimationDocument, openapi_extra=FILE_BODY)
async def upload(
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    name: Annotated[str, Query(max_length=1000, description="what to call it")] = "",
) -> Response:
    """Upload a file, as the body itself or in a form; the same bytes again are the same animation."""
    async with receive_upload(request, backend) as uploaded:
        unknown = next((field for field in uploaded.fields if field != "name"), None)
        if unknown is not None:
            raise Refusal("unknown-field", f"There is no form field {unknown!r} here. Known: name.", parameter=unknown)
        called = name or uploaded.fields.get("name", "")
        record, new = await to_thread.run_sync(register_upload, backend, owner, uploaded.parts, called)
    document = await _document(backend, record)
    return status_response(document, 201 if new else 200, {"Location": f"/v1/animations/{record.id}"})


@router.get("", response_model=AnimationPage)
async def recent(backend: BackendDependency, owner: Owner, limit: Limit = 20, cursor: Cursor = "") -> Response:
    """Animations, newest first, without their takes."""
    records = await backend.records.animations(owner, limit, decode_cursor(cursor))
    more = (
        f"/v1/animations?limit={limit}&cursor={encode_cursor(records[-1].created)}" if len(records) == limit else None
    )
    return status_response(AnimationPage(animations=tuple(map(AnimationSummary.of, records)), next=more))


@router.get("/{identifier}", response_model=AnimationDocument)
async def one(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """One animation."""
    return status_response(await _document(backend, await backend.animation(identifier, owner)))


@router.get("/{identifier}/file", responses=FILE)
async def file(
    identifier: str,
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    part: Annotated[int, Query(ge=0, description="which file of an upload of several; 0: the animation itself")] = 0,
) -> Response:
    """The uploaded bytes, whole or by Range."""
    record = await backend.animation(identifier, owner)
    if not record.parts:
        raise Refusal("gone", "The files of this animation are no longer kept. Upload it again.")
    if part >= len(record.parts):
        raise Refusal("not-found", f"The upload has {len(record.parts)} files, numbered from 0; there is no {part}.")
    chosen = record.parts[part]
    media_type = "application/octet-stream" if part else MEDIA_TYPES.get(record.format, "application/octet-stream")
    stored = StoredFile(chosen.key, chosen.bytes, media_type, chosen.name or record.name, f'"{identifier}-{part}"')
    return await to_thread.run_sync(stored_response, request, backend.blobs, stored)


@router.delete("/{identifier}", status_code=204)
async def delete(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Delete the upload and everything derived from it."""
    record = await backend.animation(identifier, owner)
    await to_thread.run_sync(delete_animation, backend.jobs, backend.blobs, record)
    return Response(status_code=204)


async def _document(backend: Backend, record: AnimationRecord) -> AnimationDocument:
    return AnimationDocument.of(record, takes=await backend.records.takes(record))
