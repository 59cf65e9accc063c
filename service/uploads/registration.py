"""Registers an upload: reads its header, makes its id from its content, and stores its files."""

import time
from collections.abc import Iterable

from redis.exceptions import ResponseError

from caesura.core.errors import UnsupportedMedia
from caesura.formats.bundle.companion_file import find_companion
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.input_formats import INPUT_FORMATS
from caesura.formats.upload_summary import Header, read_header
from caesura.service.backend import Backend
from caesura.service.http.file_name import plain_name
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.uploads.spool import Part
from caesura.worker.records import content_ids, record_types
from caesura.worker.records.record_types import AnimationRecord, TakeSummary


def register_upload(backend: Backend, owner: str, parts: tuple[Part, ...], name: str) -> tuple[AnimationRecord, bool]:
    """The animation these files are, and whether it is new. Blocks: run it on a thread.

    The same files again are the same animation, which from then on is called as they are now; one of which the store
    has lost a file is stored again. Raises what the header's reader raises; nothing is kept then.
    """
    main = _find_main_part(backend, parts)
    header = _header(backend, main)
    known = INPUT_FORMATS[header.format]
    if known.companion:
        find_companion(known, main.name, [part.name for part in parts if part is not main])
    described = [(part.name, part.bytes, part.sha256) for part in parts]
    identifier = content_ids.animation_id(backend.secret, owner, described)
    kept = backend.jobs.records.animations.one(identifier)
    if kept is not None and not all(backend.blobs.exists(part.key) for part in kept.parts):  # lost by the store
        _discard(backend, kept)
        backend.jobs.records.animations.strip(kept)
    elif kept is not None and kept.parts:
        backend.jobs.records.animations.touch(identifier)
        called = plain_name(name or main.name) or kept.name
        if called != kept.name:
            backend.jobs.records.rename_animation(identifier, called)
        return kept.model_copy(update={"name": called}), False
    takes = tuple(TakeSummary.model_validate(take, from_attributes=True) for take in header.takes)
    record = AnimationRecord(
        id=identifier,
        owner=owner,
        name=plain_name(name or main.name) or f"animation.{header.format}",
        format=header.format,
        parts=tuple(
            record_types.Part(name=part.name, key=backend.blobs.adopt(part.path), bytes=part.bytes)
            for part in [main, *(other for other in parts if other is not main)]
        ),
        take_count=len(takes),
        seconds=max((take.duration_seconds for take in takes), default=None),
        vertices=header.vertices,
        triangles=header.triangles,
        created=time.time(),
    )
    try:
        kept, ours = backend.jobs.records.animations.add(record, takes)
    except ResponseError:  # Redis's disk is full: what nothing points to would keep it so
        _discard(backend, record)
        raise
    if not ours:
        _discard(backend, record)
    return kept, ours


def _discard(backend: Backend, record: AnimationRecord) -> None:
    """Delete the files of an animation."""
    for part in record.parts:
        backend.blobs.delete(part.key)


def _find_main_part(backend: Backend, parts: tuple[Part, ...]) -> Part:
    """The file that holds the animation; the others are what it refers to, by name."""
    if not parts:
        raise RequestProblem("no-file", "The form holds no file. Send one with a filename, as curl -F file=@FILE does.")
    if len(parts) == 1:
        return parts[0]
    twice = _find_repeated_name(part.name for part in parts)
    if twice is not None:
        raise RequestProblem("duplicate-part", f"Two files of the form are called {twice!r}. Send each once.")
    readable = [part for part in parts if _is_readable(part)]
    if len(readable) == 2 and (motion := _find_motion_part(backend, readable)):
        return motion
    if len(readable) != 1:
        names = ", ".join(part.name for part in readable) or "none"
        raise RequestProblem(
            "one-animation", f"An upload is one animation with the files it refers to; readable here: {names}."
        )
    return readable[0]


def _find_motion_part(backend: Backend, pair: list[Part]) -> Part | None:
    """Of a mesh and the motion for it in a file of its own, the latter."""
    headers = [(part, _header(backend, part)) for part in pair]
    animated = [(part, header) for part, header in headers if header.takes]
    alone = animated if len(animated) == 1 else [(part, header) for part, header in animated if not header.triangles]
    return alone[0][0] if len(alone) == 1 else None


def _is_readable(part: Part) -> bool:
    """Whether it can be the animation itself: a buffer may begin with any bytes, so its name is believed."""
    if part.name.lower().endswith(".bin"):
        return False
    with part.path.open("rb") as file:
        try:
            detect_file_type(file.read(SIGNATURE_BYTES))
        except UnsupportedMedia:
            return False
    return True


def _header(backend: Backend, part: Part) -> Header:
    with part.path.open("rb") as file:
        return read_header(file, part.name, backend.settings.limits)


def _find_repeated_name(names: Iterable[str]) -> str | None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            return name
        seen.add(name)
    return None
