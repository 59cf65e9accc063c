"""Reads an animation from the files of an upload."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from mmap import mmap
from typing import BinaryIO, cast

from caesura.core.animation import Animation, Take
from caesura.core.errors import InputError, InvalidModel, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.segmentation_document import Notice
from caesura.formats.bundle.companion_file import find_companion
from caesura.formats.bundle.read import read_member, read_shapes
from caesura.formats.bundle.zip_members import ZipMembers, nested_archive_error
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.gltf.mesh_and_motion import pair_mesh_and_motion
from caesura.formats.gltf.read import read_gltf
from caesura.formats.input_formats import INPUT_FORMATS, InputFormat
from caesura.formats.npz.read import read_npz
from caesura.formats.upload_summary import read_header
from caesura.formats.zip.buffer_file import BufferFile

Scratch = Callable[[int], memoryview]
"""Gives a writable buffer of so many bytes, for what must be inflated; the caller decides where it lies."""

Part = bytes | memoryview | mmap

LONGEST_NAME = 200
"""Letters at the end of a file's name that an error repeats."""


def read_animation(parts: Mapping[str, Part], parameters: Parameters, limits: Limits, scratch: Scratch) -> Animation:
    """The animation in an upload of one or several files, by name. The buffers must outlive it.

    Raises `CaesuraError`: `UnsupportedMedia`, `BrokenContainer`, `InvalidModel`, `LimitExceeded` or, for a take
    that is not there, `ParameterError`.
    """
    views = {name: memoryview(part).toreadonly() for name, part in parts.items()}
    models = [name for name, part in views.items() if len(views) > 1 and _is_model(name, part)]
    if len(models) == 2:
        return _read_pair(views, models, parameters, limits)
    model = find_main_part(views)
    return _read_model(model, views.pop(model), views, parameters, limits, scratch)


def read_zip(data: memoryview, parameters: Parameters, limits: Limits, scratch: Scratch) -> Animation:
    """The animation of a zip: of its one model and the files beside it, or of numbered shapes."""
    files = ZipMembers(cast("BinaryIO", BufferFile(data)), limits)
    if files.are_arrays():
        return read_npz(data, parameters, limits, scratch)
    name = files.model()
    if name is None:
        return read_shapes(files, data, parameters, limits, scratch)
    views = {called: read_member(files, other, data, scratch) for called, other in files.beside(name).items()}
    model = read_member(files, name, data, scratch)
    if INPUT_FORMATS[detect_file_type(bytes(model[:SIGNATURE_BYTES]))].is_archive:
        raise nested_archive_error(name)
    return _read_model(name, model, views, parameters, limits, scratch)


def _read_model(
    name: str,
    data: memoryview,
    beside: dict[str, memoryview],
    parameters: Parameters,
    limits: Limits,
    scratch: Scratch,
) -> Animation:
    """The animation of one file and those `beside` it, whatever its format."""
    known = INPUT_FORMATS[detect_file_type(bytes(data[:SIGNATURE_BYTES]))]
    if known.reader:
        companion = _companion(known, name, beside)
        with _errors_of(name):
            animation: Animation = known.load(known.reader)(data, *companion, parameters, limits, scratch)
        return animation
    converted = _convert_to_gltf(known, name, data, beside, limits)
    return _with_notices(read_gltf(memoryview(converted.glb), beside, parameters, limits), converted.notices)


def _convert_to_gltf(
    known: InputFormat, name: str, data: memoryview, beside: Mapping[str, memoryview], limits: Limits
) -> GltfConversion:
    if not known.to_gltf:
        return GltfConversion(data)
    companion = _companion(known, name, beside)
    with _errors_of(name):
        converted: GltfConversion = known.load(known.to_gltf)(data, *companion, limits)
    return converted


@contextmanager
def _errors_of(name: str) -> Iterator[None]:
    """Let a refusal of a file say which one it is, where it has a name."""
    try:
        yield
    except InputError as wrong:
        if name:
            wrong.where.setdefault("file", name[-LONGEST_NAME:])
        raise


def _with_notices(animation: Animation, notices: tuple[Notice, ...]) -> Animation:
    return replace(animation, notices=(*notices, *animation.notices))


def _companion(known: InputFormat, name: str, beside: Mapping[str, memoryview]) -> tuple[memoryview, ...]:
    return (beside[find_companion(known, name, beside)],) if known.companion else ()


def _read_pair(views: dict[str, memoryview], models: list[str], parameters: Parameters, limits: Limits) -> Animation:
    """The animation of a mesh in one file and its motion in another; a BVH may be the latter."""
    opened = {name: views.pop(name) for name in models}
    first, second = (_open_as_gltf(name, data, views, limits) for name, data in opened.items())
    pair = pair_mesh_and_motion(memoryview(first.glb), memoryview(second.glb), limits)
    animation = read_gltf(memoryview(pair.json), {**views, **pair.parts}, parameters, limits)
    return _with_notices(animation, (pair.notice, *first.notices, *second.notices))


def _open_as_gltf(name: str, data: memoryview, beside: Mapping[str, memoryview], limits: Limits) -> GltfConversion:
    known = INPUT_FORMATS[detect_file_type(bytes(data[:SIGNATURE_BYTES]))]
    if known.reader:
        raise InvalidModel(
            "ambiguous-upload", f"A file of kind {known.title} is an animation of its own. Send it without another."
        )
    return _convert_to_gltf(known, name, data, beside, limits)


def list_takes(parts: Mapping[str, Part], limits: Limits) -> tuple[Take, ...]:
    """The takes that an upload offers, by its headers alone; frames and rates are estimates there."""
    views = {name: memoryview(part).toreadonly() for name, part in parts.items()}
    name = find_main_part(views)
    header = read_header(cast("BinaryIO", BufferFile(views[name])), name, limits)
    return tuple(
        Take(take.index, take.name, take.duration_seconds, take.frames, take.frame_rate) for take in header.takes
    )


def find_main_part(parts: Mapping[str, memoryview]) -> str:
    """The name of the part that is the animation itself: the only one, or the only one that can be read alone."""
    if len(parts) == 1:
        return next(iter(parts))
    models = [name for name, data in parts.items() if _is_model(name, data)]
    if len(models) == 1:
        return models[0]
    raise InvalidModel(
        "ambiguous-upload",
        f"{len(models)} of the {len(parts)} files sent are models. Send one with the files that belong to it.",
    )


def _is_model(name: str, data: memoryview) -> bool:
    if name.lower().endswith(".bin"):  # a buffer may begin with any bytes
        return False
    try:
        detect_file_type(bytes(data[:SIGNATURE_BYTES]))
    except UnsupportedMedia:
        return False
    return True
