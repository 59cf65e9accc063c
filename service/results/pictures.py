"""Pictures of poses that a client drew of a result, kept with it: the page draws them once.

They are two files of the result: a document with one sheet of all pictures, and the first of them by itself. They go
with the result, and with what was uploaded.
"""

import time
from typing import Annotated

from anyio import to_thread
from fastapi import Request
from pydantic import Base64Bytes, BaseModel, ConfigDict, Field, ValidationError, model_validator

from caesura.core.errors import ParameterError
from caesura.formats.playback.image_header import read_image_header
from caesura.service.backend import Backend
from caesura.service.http.json_body import read_json_body
from caesura.worker.records.record_types import ExportRecord, SegmentationRecord

PICTURES, POSTER = "pictures", "poster"
"""The forms under which they are kept."""
COLUMNS = 8
MOST_PICTURES = 96
LARGEST_SIDE = 256
"""Pixels of a picture."""

Frame = Annotated[int, Field(ge=0, lt=2**31)]


class Pictures(BaseModel):
    """Pictures of poses on one sheet, eight in a row, each of `width` by `height` pixels; `poster` is one of them."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    width: int = Field(ge=1, le=LARGEST_SIDE)
    height: int = Field(ge=1, le=LARGEST_SIDE)
    frames: tuple[Frame, ...] = Field(min_length=1, max_length=MOST_PICTURES, description="of each picture, in order")
    sheet: Base64Bytes = Field(description="a PNG, JPEG or WebP")
    poster: Base64Bytes = Field(description="a PNG, JPEG or WebP")

    @model_validator(mode="after")
    def _check_images(self) -> "Pictures":
        rows = -(-len(self.frames) // COLUMNS)
        columns = min(len(self.frames), COLUMNS)
        for name, width, height in (
            ("sheet", columns * self.width, rows * self.height),
            ("poster", self.width, self.height),
        ):
            header = read_image_header(memoryview(getattr(self, name)))
            if header is None or (header.width, header.height) != (width, height):
                raise ValueError(f"the {name} must be a PNG, JPEG or WebP of {width} x {height} pixels")
        return self


async def read_pictures(request: Request, record: SegmentationRecord) -> Pictures:
    """The body; raises `ParameterError` where it is no such document, or names a frame that there is not."""
    given = await read_json_body(request, '{"width": 96, "height": 72, "frames": [0], "sheet": "…", "poster": "…"}')
    try:
        pictures = Pictures.model_validate(given)
    except ValidationError as refused:
        first = refused.errors(include_url=False, include_context=False, include_input=False)[0]
        pointer = "".join(f"/{str(step)[:50]}" for step in first["loc"])
        raise ParameterError("invalid-parameter", f"{first['msg']}.", pointer=pointer) from None
    if max(pictures.frames) >= (record.frames or 0):
        raise ParameterError("invalid-parameter", f"The take has {record.frames} frames.", pointer="/frames")
    return pictures


async def keep_pictures(backend: Backend, record: SegmentationRecord, pictures: Pictures) -> bool:
    """Keep the pictures of a result; False where it has some, or was deleted meanwhile."""
    if await backend.records.export(record.id, PICTURES) is not None:
        return False
    image = read_image_header(memoryview(pictures.poster))
    media_type = "" if image is None else image.media_type
    files = ((POSTER, pictures.poster, media_type), (PICTURES, pictures.model_dump_json().encode(), "application/json"))
    return all([await to_thread.run_sync(_keep_file, backend, record.id, *file) for file in files])


def _keep_file(backend: Backend, identifier: str, form: str, data: bytes, media_type: str) -> bool:
    key = backend.blobs.put(data, "exports", backend.settings.min_free_bytes)
    made = ExportRecord(key=key, media_type=media_type, created=time.time())
    kept = backend.jobs.records.exports.add(identifier, form, made)
    if not kept:
        backend.blobs.delete(key)
    return kept
