"""Uploaded files."""

from typing import Annotated
from urllib.parse import urlencode

from anyio import to_thread
from fastapi import APIRouter, Query, Request, Response
from pydantic import BaseModel, Field

from caesura.core.errors import ParameterError
from caesura.service.api_description.media_types import FILE, UPLOADED
from caesura.service.api_description.request_bodies import FILE_BODY, UPLOAD_URL
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.http.file_name import LONGEST_NAME, plain_name
from caesura.service.http.outgoing.target_url import LONGEST_URL
from caesura.service.http.paging import Cursor, Limit, decode_cursor, encode_cursor
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.response_documents import AnimationDocument, AnimationPage, AnimationSummary
from caesura.service.results.byte_ranges import StoredFile, stored_response
from caesura.service.segmentations.document_response import document_response
from caesura.service.uploads.registration import register_upload
from caesura.service.uploads.remote_file import fetch_upload
from caesura.service.uploads.upload_body import receive_upload
from caesura.worker.records.record_types import AnimationRecord
from caesura.worker.retention import deletion

MEDIA_TYPES = {
    "glb": "model/gltf-binary",
    "gltf": "model/gltf+json",
    "npz": "application/x-npz",
    "zip": "application/zip",
}

Search = Annotated[str, Query(max_length=LONGEST_NAME, description="part of a name, in any case of letters")]


class NewName(BaseModel):
    """What an animation is called from now on."""

    name: str = Field(min_length=1, max_length=LONGEST_NAME)


router = APIRouter(prefix="/v1/animations", tags=["animations"])


@router.post("", status_code=201, response_model=AnimationDocument, responses=UPLOADED, openapi_extra=FILE_BODY)
async def upload_animation(
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    name: Annotated[str, Query(max_length=1000, description="what to call it")] = "",
    url: Annotated[str, Query(max_length=LONGEST_URL, description=UPLOAD_URL)] = "",
) -> Response:
    """Upload a file.

    It is the body itself, comes in a form with the files that it refers to, or is fetched from `url`. The same bytes
    are the same animation.
    """
    source = fetch_upload(backend, url, name) if url else receive_upload(request, backend)
    async with source as uploaded:
        unknown = next((field for field in uploaded.fields if field != "name"), None)
        if unknown is not None:
            raise RequestProblem(
                "unknown-field", f"There is no form field {unknown!r} here. Known: name.", parameter=unknown
            )
        called = name or uploaded.fields.get("name", "")
        record, new = await to_thread.run_sync(register_upload, backend, owner, uploaded.parts, called)
    document = await _document(backend, record)
    return document_response(document, 201 if new else 200, {"Location": f"/v1/animations/{record.id}"})


@router.get("", response_model=AnimationPage)
async def list_animations(
    backend: BackendDependency, owner: Owner, limit: Limit = 20, cursor: Cursor = "", search: Search = ""
) -> Response:
    """List animations, newest first.

    They come without their takes; with `search`, those whose names hold these words.
    """
    records, last = await backend.records.find_animations(owner, limit, decode_cursor(cursor), search)
    edited = await backend.records.last_edited([record.id for record in records])
    listed = tuple(AnimationSummary.of(record, edited=one) for record, one in zip(records, edited, strict=True))
    query = urlencode({"limit": limit, **({"search": search} if search else {})})
    more = None if last is None else f"/v1/animations?{query}&cursor={encode_cursor(last)}"
    return document_response(AnimationPage(animations=listed, next=more))


@router.get("/{identifier}", response_model=AnimationDocument)
async def get_animation(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Describe one animation."""
    return document_response(await _document(backend, await backend.animation(identifier, owner)))


@router.patch("/{identifier}", response_model=AnimationDocument)
async def rename_animation(identifier: str, given: NewName, backend: BackendDependency, owner: Owner) -> Response:
    """Rename an animation.

    What was made of it under its name is called so too.
    """
    await backend.animation(identifier, owner)
    name = plain_name(given.name)
    if not name:
        raise ParameterError("invalid-parameter", "The name holds nothing that prints. Send another.", pointer="/name")
    await to_thread.run_sync(backend.jobs.records.rename_animation, identifier, name)
    return document_response(await _document(backend, await backend.animation(identifier, owner)))


@router.get("/{identifier}/file", response_class=Response, responses=FILE)
async def download_animation(
    identifier: str,
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    part: Annotated[int, Query(ge=0, description="which file of an upload of several; 0: the animation itself")] = 0,
) -> Response:
    """Download an uploaded file, whole or by `Range`."""
    record = await backend.animation(identifier, owner)
    if not record.parts:
        raise RequestProblem("gone", "The files of this animation are no longer kept. Upload it again.")
    if part >= len(record.parts):
        raise RequestProblem(
            "not-found", f"The upload has {len(record.parts)} files, numbered from 0; there is no {part}."
        )
    chosen = record.parts[part]
    media_type = "application/octet-stream" if part else MEDIA_TYPES.get(record.format, "application/octet-stream")
    stored = StoredFile(chosen.key, chosen.bytes, media_type, chosen.name or record.name, f'"{identifier}-{part}"')
    return await to_thread.run_sync(stored_response, request, backend.blobs, stored)


@router.delete("/{identifier}", status_code=204)
async def delete_animation(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Delete an upload and everything made of it."""
    record = await backend.animation(identifier, owner)
    await to_thread.run_sync(deletion.delete_animation, backend.jobs, backend.blobs, record)
    return Response(status_code=204)


async def _document(backend: Backend, record: AnimationRecord) -> AnimationDocument:
    (edited,) = await backend.records.last_edited([record.id])
    return AnimationDocument.of(record, takes=await backend.records.takes(record), edited=edited)
