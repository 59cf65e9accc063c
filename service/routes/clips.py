"""The uploaded file again, with the motions as clips, or with the key poses alone."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from fastapi import APIRouter, Query, Request, Response
from pydantic import BaseModel, Field

from caesura.core.segmentation_document import Loop, SegmentationDocument
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.clip_plan import TakeFrames, plan_clips
from caesura.service.api_description.media_types import CLIPS, KEY_POSES
from caesura.service.api_description.request_bodies import WAIT
from caesura.service.auth.request_owner import Owner
from caesura.service.backend import Backend, BackendDependency
from caesura.service.http.prefer_header import preferred_wait_seconds
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.results.result_response import download_stem, result_file_response, unfinished_response
from caesura.service.results.revision_request import WHICH, Revision, revised_document, revision_number
from caesura.service.segmentations.document_response import document_response
from caesura.worker.records.record_types import TakeSummary


class ClipQuery(ClipOptions):
    """The choices, and the revision whose segments the clips are of."""

    revision: str = Field("0", description=WHICH)

    def choices(self) -> str:
        """Those of how clips are made, as `ClipOptions.canonical`."""
        return ClipOptions.of(self.model_dump(exclude={"revision"})).canonical()


@dataclass(frozen=True)
class ResultFileRequest:
    """Which file of a result is asked for: its kind, the revision and the choices of clips."""

    what: str
    revision: str
    choices: str = ""


class PlannedClip(BaseModel):
    """A clip that there would be; seconds are those of the take, handles included. `loop` where it is cut to one."""

    name: str
    motion: str
    segment: int = Field(description="from 1")
    start_seconds: float
    end_seconds: float
    loop: Loop | None = None


class ClipPlan(BaseModel):
    """The clips that there would be, in order."""

    clips: tuple[PlannedClip, ...]


router = APIRouter(prefix="/v1/segmentations/{identifier}", tags=["clips"])


@router.get("/clips", response_class=Response, responses=CLIPS, openapi_extra=WAIT)
async def get_clips(
    identifier: str, request: Request, backend: BackendDependency, owner: Owner, options: Annotated[ClipQuery, Query()]
) -> Response:
    """Fetch the uploaded file with one named animation for each segment.

    All else in it is untouched. It is a zip where `files=separate`, and of other formats: a file of the kind that was
    sent for each segment.
    """
    return await _respond_with_file(
        identifier, request, backend, owner, ResultFileRequest("clips", options.revision, options.choices())
    )


@router.get("/clips/plan", response_model=ClipPlan)
async def get_clip_plan(
    identifier: str, request: Request, backend: BackendDependency, owner: Owner, options: Annotated[ClipQuery, Query()]
) -> Response:
    """List the clips that there would be.

    They are those that `clips` would make with the same choices. Nothing is written.
    """
    record = await backend.segmentation(identifier, owner)
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    animation = await backend.animation(record.animation, owner)
    takes = await backend.records.takes(animation)
    document = await revised_document(backend, record, revision_number(record, options.revision))
    planned = planned_clips(document, ClipOptions.parse(options.choices()), takes)
    return document_response(ClipPlan(clips=planned))


@router.get("/keyframes", response_class=Response, responses=KEY_POSES, openapi_extra=WAIT)
async def get_key_frames(
    identifier: str, request: Request, backend: BackendDependency, owner: Owner, revision: Revision = "0"
) -> Response:
    """Fetch the uploaded file with one animation that steps from key pose to key pose."""
    return await _respond_with_file(identifier, request, backend, owner, ResultFileRequest("keyframes", revision))


def planned_clips(
    document: SegmentationDocument, options: ClipOptions, takes: Sequence[TakeSummary]
) -> tuple[PlannedClip, ...]:
    """The clips of a document, of a file with these takes, planned as the worker does who has the file open."""
    start, rate = document.source.start_seconds, document.frame_rate
    last = start + (document.frames - 1) / rate
    whole = TakeFrames(document.source.take, 0, document.frames, start, last, last)
    alone = options.animation_only or options.files == "separate"
    gone = {take.index for take in takes} if alone else set() if options.keep_source else {document.source.take}
    taken = [take.name for take in takes if take.index not in gone and document.source.take >= 0]
    return tuple(
        PlannedClip(
            name=clip.name,
            motion=document.segments[clip.segment - 1].name,
            segment=clip.segment,
            start_seconds=clip.start,
            end_seconds=clip.end,
            loop=clip.loop,
        )
        for clip in plan_clips(document, options, [whole], taken)
    )


async def _respond_with_file(
    identifier: str, request: Request, backend: Backend, owner: str, made: ResultFileRequest
) -> Response:
    record = await backend.wait_until_settled(
        await backend.segmentation(identifier, owner), preferred_wait_seconds(request)
    )
    refused = unfinished_response(request, record)
    if refused is not None:
        return refused
    animation = await backend.animation(record.animation, owner)
    if not animation.parts:
        raise RequestProblem("gone", "The upload is no longer kept here: its time has run out. Upload it again.")
    number = revision_number(record, made.revision)
    query = "&".join(filter(None, (f"revision={number}" if number else "", made.choices)))
    form = f"{made.what}?{query}" if query else made.what
    here = f"/v1/segmentations/{identifier}/{form}"
    name = f"{await download_stem(backend, record)}-{made.what}.glb"
    return await result_file_response(backend, request, record, form, here, name)
