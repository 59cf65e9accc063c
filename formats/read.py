"""Reads an animation from the files of an upload."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from mmap import mmap
from typing import BinaryIO, cast

from caesura.core.animation import Animation, Take
from caesura.core.errors import InvalidModel, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.bundle.read import read_member, read_shapes
from caesura.formats.bundle.zip_members import ZipMembers, refuse_nested_archive
from caesura.formats.file_header import read_header
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.gltf.read import read_gltf
from caesura.formats.input_formats import INPUT_FORMATS, InputFormat
from caesura.formats.mesh_and_motion import pair_mesh_and_motion
from caesura.formats.npz.read import read_npz
from caesura.formats.zip.buffer_file import BufferFile

Scratch = Callable[[int], memoryview]
"""Gives a writable buffer of so many bytes, for what must be inflated; the caller decides where it lies."""

Part = bytes | memoryview | mmap


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
    data = views.pop(model)
    known = INPUT_FORMATS[detect_file_type(bytes(data[:SIGNATURE_BYTES]))]
    if known.reader:
        animation: Animation = known.load(known.reader)(data, parameters, limits, scratch)
        return animation
    return read_gltf(_convert_to_gltf(known, data, limits), views, parameters, limits)


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
    known = INPUT_FORMATS[detect_file_type(bytes(model[:SIGNATURE_BYTES]))]
    if known.reader:
        raise refuse_nested_archive(name)
    return read_gltf(_convert_to_gltf(known, model, limits), views, parameters, limits)


def _convert_to_gltf(known: InputFormat, data: memoryview, limits: Limits) -> memoryview:
    return memoryview(known.load(known.to_gltf)(data, limits)) if known.to_gltf else data


def _read_pair(views: dict[str, memoryview], models: list[str], parameters: Parameters, limits: Limits) -> Animation:
    """The animation of a mesh in one file and its motion in another; a BVH may be the latter."""
    first, second = (_open_as_gltf(views.pop(name), limits) for name in models)
    pair = pair_mesh_and_motion(first, second, limits)
    animation = read_gltf(memoryview(pair.json), {**views, **pair.parts}, parameters, limits)
    return replace(animation, notices=(pair.notice, *animation.notices))


def _open_as_gltf(data: memoryview, limits: Limits) -> memoryview:
    known = INPUT_FORMATS[detect_file_type(bytes(data[:SIGNATURE_BYTES]))]
    if known.reader:
        raise InvalidModel("ambiguous-upload", "An archive is an animation of its own. Send it without other files.")
    return _convert_to_gltf(known, data, limits)


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
        f"{len(models)} of the {len(parts)} files sent are models. Send one .gltf or .glb with the files it names.",
    )


def _is_model(name: str, data: memoryview) -> bool:
    if name.lower().endswith(".bin"):  # a buffer may begin with any bytes
        return False
    try:
        detect_file_type(bytes(data[:SIGNATURE_BYTES]))
    except UnsupportedMedia:
        return False
    return True
