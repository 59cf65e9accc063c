"""Results, in every form; and what the page plays."""

from typing import Annotated, Literal

from anyio import to_thread
from fastapi import APIRouter, HTTPException, Query, Request, Response

from caesura.formats.exports.export_table import EXPORTS, Export, exports_of
from caesura.service.api_description.media_types import BLOCKS, MODEL, RESULT, export_answers
from caesura.service.api_description.request_bodies import WAIT
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.response_documents import ViewerDocument
from caesura.service.results.byte_ranges import StoredFile, stored_response
from caesura.service.results.result_formats import export_by_accept, export_by_suffix
from caesura.service.results.result_response import RequestedResult, result_response
from caesura.service.results.revision_request import Revision
from caesura.service.segmentations.document_response import document_response
from caesura.worker.records.record_types import ViewerRecord

Table = Annotated[Literal["segments", "frames"], Query(description="csv: a row per segment, or per frame")]

STEMS = ("result", "plot")
"""Results whose addresses end in their form."""

router = APIRouter(prefix="/v1/segmentations/{identifier}", tags=["results"])


@router.get("/result", response_class=Response, responses=RESULT, openapi_extra=WAIT)
async def get_result(
    identifier: str,
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    table: Table = "segments",
    revision: Revision = "0",
) -> Response:
    """Fetch the result, in the form that `Accept` likes best.

    It is the segmentation document where anything will do.
    """
    wanted = RequestedResult(export_by_accept(request.headers.get("accept", "")), table, revision)
    return await result_response(backend, request, await backend.segmentation(identifier, owner), wanted)


def _add_form(export: Export) -> None:
    """Give one form of the result an address and an operation of its own."""

    async def form_with_tables(
        identifier: str,
        request: Request,
        backend: BackendDependency,
        owner: Owner,
        table: Table = "segments",
        revision: Revision = "0",
    ) -> Response:
        wanted = RequestedResult(export, table, revision)
        return await result_response(backend, request, await backend.segmentation(identifier, owner), wanted)

    async def form(
        identifier: str, request: Request, backend: BackendDependency, owner: Owner, revision: Revision = "0"
    ) -> Response:
        return await form_with_tables(identifier, request, backend, owner, "segments", revision)

    router.add_api_route(
        f"/{export.path}",
        form_with_tables if export.suffix in exports_of(export.stem, "frames") else form,
        name=f"get_{export.stem}_{export.suffix}",
        description=f"Fetch the {export.stem} as {export.title.rpartition(', ')[2]}.\n\nIt is {export.description}.",
        response_class=Response,
        responses=export_answers(export),
        openapi_extra=WAIT,
    )


for _export in EXPORTS:
    if _export.stem in STEMS and _export.table == "segments":
        _add_form(_export)


@router.get("/{stem}.{suffix}", include_in_schema=False)
async def refuse_unknown_form(stem: str, suffix: str) -> Response:
    """Say which forms there are."""
    if stem not in STEMS:
        raise HTTPException(404)
    export_by_suffix(stem, suffix)
    raise AssertionError("a form without an address of its own")


@router.get("/viewer", response_model=ViewerDocument)
async def get_viewer(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """Describe what the page plays, and where it is."""
    shown = await _viewer_record(backend, identifier, owner)
    here = f"/v1/segmentations/{identifier}/viewer"
    parts = {"model": shown.model, "strain": shown.strain, "materials": shown.materials}
    addresses = {name: f"{here}/{name}" if key else None for name, key in parts.items()}
    return document_response(ViewerDocument.model_validate({**shown.document, **addresses}))


@router.get("/viewer/model", response_class=Response, responses=MODEL)
async def get_viewer_model(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Fetch the figure that the page plays: a plain GLB, or blocks of vertices."""
    shown = await _viewer_record(backend, identifier, owner)
    media_type = "model/gltf-binary" if shown.document.get("kind") == "gltf" else "application/octet-stream"
    return await _blob_response(request, backend, shown.model, media_type)


@router.get("/viewer/strain", response_class=Response, responses=BLOCKS)
async def get_viewer_strain(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Fetch how strained each patch is at each frame, in blocks."""
    shown = await _viewer_record(backend, identifier, owner)
    if shown.strain is None:
        raise RequestProblem("not-found", "There is no strain: the animation has no triangles.")
    return await _blob_response(request, backend, shown.strain, "application/octet-stream")


@router.get("/viewer/materials", response_class=Response, responses=MODEL)
async def get_viewer_materials(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """Fetch the materials of the figure with their images, as a GLB without a scene."""
    shown = await _viewer_record(backend, identifier, owner)
    if shown.materials is None:
        raise RequestProblem("not-found", "The model has no images.")
    return await _blob_response(request, backend, shown.materials, "model/gltf-binary")


async def _viewer_record(backend: Backend, identifier: str, owner: str) -> ViewerRecord:
    record = await backend.segmentation(identifier, owner)
    if record.analysis is None or record.analysis.viewer is None:
        raise RequestProblem("not-finished", f"It is {record.status}: there is nothing to play yet.")
    return record.analysis.viewer


async def _blob_response(request: Request, backend: Backend, key: str, media_type: str) -> Response:
    """Blob keys are random and never written twice, so the key's own end is the tag."""
    name = key.rpartition("/")[2]
    size = await to_thread.run_sync(backend.blobs.size, key)
    stored = StoredFile(key, size, media_type, name, f'"{name}"')
    return await to_thread.run_sync(stored_response, request, backend.blobs, stored)
