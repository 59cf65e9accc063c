"""Pictures of poses, drawn by the page and kept with a result."""

from anyio import to_thread
from fastapi import APIRouter, Request, Response

from caesura.service.api_description.media_types import PICTURE_FILE, PICTURE_SHEET
from caesura.service.api_description.request_bodies import PICTURES_BODY
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.results.byte_ranges import StoredFile, stored_response
from caesura.service.results.pictures import PICTURES, POSTER, Pictures, keep_pictures, read_pictures
from caesura.service.results.result_response import unfinished_response
from caesura.worker.store.blobs import BlobMissing

router = APIRouter(prefix="/v1/segmentations/{identifier}", tags=["results"])


@router.put("/pictures", status_code=204, response_class=Response, openapi_extra=PICTURES_BODY)
async def put_pictures(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Keep pictures of poses with a result.

    Those that came first stay: the answer is the same where there are some.
    """
    record = await backend.segmentation(identifier, owner)
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    await keep_pictures(backend, record, await read_pictures(request, record))
    return Response(status_code=204)


@router.get("/pictures", response_model=Pictures, responses=PICTURE_SHEET)
async def get_pictures(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Fetch the pictures of poses that are kept with a result.

    204 where nobody has drawn any yet.
    """
    return await _kept_response(identifier, request, backend, owner, PICTURES)


@router.get("/poster", response_class=Response, responses=PICTURE_FILE)
async def get_poster(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Fetch one picture that stands for a result.

    204 where nobody has drawn any yet.
    """
    return await _kept_response(identifier, request, backend, owner, POSTER)


async def _kept_response(identifier: str, request: Request, backend: Backend, owner: str, form: str) -> Response:
    record = await backend.segmentation(identifier, owner)
    kept = await backend.records.export(record.id, form)
    try:
        if kept is not None and kept.key is not None:
            size = await to_thread.run_sync(backend.blobs.size, kept.key)
            stored = StoredFile(kept.key, size, kept.media_type, form, f'"{kept.key.rpartition("/")[2]}"')
            return await to_thread.run_sync(stored_response, request, backend.blobs, stored)
    except BlobMissing:
        pass
    return Response(status_code=204, headers={"Cache-Control": "no-store"})
