"""The uploaded file again, with the motions as clips, or with the key poses alone."""

from pathlib import PurePath
from typing import Annotated

from fastapi import APIRouter, Query, Request, Response

from core.formats.clips.options import ClipOptions
from service.access import Owner
from service.backend import Backend, Behind
from service.descriptions import CLIPS, KEY_POSES
from service.errors import Refusal
from service.preferences import wait_seconds
from service.results import made_file, unfinished

router = APIRouter(prefix="/v1/segmentations/{identifier}", tags=["clips"])


@router.get("/clips", responses=CLIPS)
async def clips(
    identifier: str, request: Request, backend: Behind, owner: Owner, options: Annotated[ClipOptions, Query()]
) -> Response:
    """The uploaded glTF with one named animation for each segment, all else untouched.

    A zip where `files=separate`, and of a vertex sequence.
    """
    return await _made(identifier, request, backend, owner, "clips", options.canonical())


@router.get("/keyframes", responses=KEY_POSES)
async def keyframes(identifier: str, request: Request, backend: Behind, owner: Owner) -> Response:
    """The uploaded glTF with one animation that steps from key pose to key pose."""
    return await _made(identifier, request, backend, owner, "keyframes", "")


async def _made(identifier: str, request: Request, backend: Backend, owner: str, what: str, options: str) -> Response:
    record = await backend.awaited(await backend.segmentation(identifier, owner), wait_seconds(request))
    refused = unfinished(request, record)
    if refused is not None:
        return refused
    animation = await backend.animation(record.animation, owner)
    if not animation.parts:
        raise Refusal("gone", "The upload is no longer kept here: its time has run out. Upload it again.")
    form = f"{what}?{options}" if options else what
    stem = PurePath(record.name or animation.name).stem or record.id
    here = f"/v1/segmentations/{identifier}/{form}"
    return await made_file(backend, request, record, form, here, f"{stem}-{what}.glb")
