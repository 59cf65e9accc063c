"""Results, in every form; and what the page plays."""

from typing import Annotated, Literal

from anyio import to_thread
from fastapi import APIRouter, Query, Request, Response

from caesura.service.api_description.descriptions import FILE, PLOT, RESULT
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.documents import ViewerDocument
from caesura.service.problems.status_table import Refusal
from caesura.service.results.byte_ranges import StoredFile, stored_response
from caesura.service.results.result_formats import format_by_accept, format_by_suffix, plot_format_by_suffix
from caesura.service.results.result_response import RequestedResult, result_response
from caesura.service.results.revision_request import Revision
from caesura.service.segmentations.status_response import status_response
from caesura.worker.records.schema import ViewerRecord

Table = Annotated[Literal["segments", "frames"], Query(description="csv: a row per segment, or per frame")]

router = APIRouter(prefix="/v1/segmentations/{identifier}", tags=["results"])


@router.get("/result", responses=RESULT)
async def by_header(
    identifier: str,
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    table: Table = "segments",
    revision: Revision = "0",
) -> Response:
    """The result, in the form that Accept likes best; the segmentation document where anything will do."""
    wanted = RequestedResult(format_by_accept(request.headers.get("accept", "")), table, revision)
    return await result_response(backend, request, await backend.segmentation(identifier, owner), wanted)


@router.get("/result.{suffix}", responses=RESULT)
async def by_name(
    identifier: str,
    suffix: str,
    request: Request,
    backend: BackendDependency,
    owner: Owner,
    table: Table = "segments",
    revision: Revision = "0",
) -> Response:
    """The result in the form that the address ends in: json, csv, npz, vtt or eaf."""
    wanted = RequestedResult(format_by_suffix(suffix), table, revision)
    return await result_response(backend, request, await backend.segmentation(identifier, owner), wanted)


@router.get("/plot.{suffix}", responses=PLOT)
async def plot(
    identifier: str, suffix: str, request: Request, backend: BackendDependency, owner: Owner, revision: Revision = "0"
) -> Response:
    """The energy curve with key-frames, cuts and coloured segments, as in the paper's figures: svg or png."""
    wanted = RequestedResult(plot_format_by_suffix(suffix), revision=revision)
    return await result_response(backend, request, await backend.segmentation(identifier, owner), wanted)


@router.get("/viewer", response_model=ViewerDocument)
async def viewer(identifier: str, backend: BackendDependency, owner: Owner) -> Response:
    """What the page plays, and where it is."""
    shown = await _shown(backend, identifier, owner)
    here = f"/v1/segmentations/{identifier}/viewer"
    addresses = {"model": f"{here}/model", "strain": f"{here}/strain" if shown.strain else None}
    return status_response(ViewerDocument.model_validate({**shown.document, **addresses}))


@router.get("/viewer/model", responses=FILE)
async def model(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """The figure: a plain GLB, or blocks of vertices."""
    shown = await _shown(backend, identifier, owner)
    media_type = "model/gltf-binary" if shown.document.get("kind") == "gltf" else "application/octet-stream"
    return await _blob(request, backend, shown.model, media_type)


@router.get("/viewer/strain", responses=FILE)
async def strain(identifier: str, request: Request, backend: BackendDependency, owner: Owner) -> Response:
    """How strained each patch is at each frame, in blocks."""
    shown = await _shown(backend, identifier, owner)
    if shown.strain is None:
        raise Refusal("not-found", "There is no strain: the animation has no triangles.")
    return await _blob(request, backend, shown.strain, "application/octet-stream")


async def _shown(backend: Backend, identifier: str, owner: str) -> ViewerRecord:
    record = await backend.segmentation(identifier, owner)
    if record.analysis is None or record.analysis.viewer is None:
        raise Refusal("not-finished", f"It is {record.status}: there is nothing to play yet.")
    return record.analysis.viewer


async def _blob(request: Request, backend: Backend, key: str, media_type: str) -> Response:
    """Blob keys are random and never written twice, so the key's own end is the tag."""
    name = key.rpartition("/")[2]
    size = await to_thread.run_sync(backend.blobs.size, key)
    stored = StoredFile(key, size, media_type, name, f'"{name}"')
    return await to_thread.run_sync(stored_response, request, backend.blobs, stored)
