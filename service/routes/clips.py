"""The uploaded file again, with the motions as clips, or with the key poses alone."""

from dataclasses import dataclass
from pathlib import PurePath
from typing import Annotated

from fastapi import APIRouter, Query, Request, Response
from pydantic import Field

from caesura.formats.clips.clip_options import ClipOptions
from caesura.service.api_description.descriptions import CLIPS, KEY_POSES
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.problems.status_table import Refusal
from caesura.service.results.result_response import result_file_response, unfinished_response
from caesura.service.results.revision_request import WHICH, Revision, revision_number


class ClipQuery(ClipOptions):
    """The choices, and the revision whose segments the clips are of."""

    revision: str = Field("0", description=WHICH)

    def choices(self) -> str:
        """Those of how clips are made, as `ClipOptions.canonical`."""
        return ClipOptions.of(self.model_dump(exclude={"revision"})).canonical()


@dataclass(frozen=True)
class _Made:
    what: str
    revision: str
    choices: str = ""


router = APIRouter(prefix="/v1/segmentations/{identifier}", tags=["clips"])


@router.get("/clips", responses=CLIPS)
async def clips(
    identifier: str, request: Request, backend: BackendDependency, owner: Owner, options: Annotated[ClipQuery, Query()]
) -> Response:
    """The uploaded glTF with one named animation for each segment, all else untouched.

    A zip where `files=separate`, and of a vertex sequence.
    """
    return await _made(identifier, request, backend, owner, _Made("clips", options.revision, options.choices()))


@router.get("/keyframes", responses=KEY_POSES)
async def keyframes(
    identifier: str, request: Request, backend: BackendDependency, owner: Owner, revision: Revision = "0"
) -> Response:
    """The uploaded glTF with one animation that steps from key pose to key pose."""
    return await _made(identifier, request, backend, owner, _Made("keyframes", revision))


async def _made(identifier: str, request: Request, backend: Backend, owner: str, made: _Made) -> Response:
    record = await backend.wait_until_settled(
        await backend.segmentation(identifier, owner), preferred_wait_seconds(request)
    )
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    animation = await backend.animation(record.animation, owner)
    if not animation.parts:
        raise Refusal("gone", "The upload is no longer kept here: its time has run out. Upload it again.")
    number = revision_number(record, made.revision)
    query = "&".join(filter(None, (f"revision={number}" if number else "", made.choices)))
    form = f"{made.what}?{query}" if query else made.what
    stem = PurePath(record.name or animation.name).stem or record.id
    here = f"/v1/segmentations/{identifier}/{form}"
    return await result_file_response(backend, request, record, form, here, f"{stem}-{made.what}.glb")
