"""The file of an upload that is the animation, out of its zip, and those beside it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import BinaryIO, cast

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.bundle.read import read_member
from caesura.formats.bundle.zip_members import ZipMembers
from caesura.formats.file_type import SIGNATURE_BYTES, detect_file_type
from caesura.formats.input_formats import INPUT_FORMATS, InputFormat
from caesura.formats.read import find_main_part
from caesura.formats.zip.buffer_file import BufferFile


@dataclass(frozen=True)
class AnimationFile:
    """Its format, name and bytes, and the other files by their names. Of a zip of shapes it is the zip."""

    known: InputFormat
    name: str
    data: memoryview
    beside: Mapping[str, memoryview]


def open_animation_file(views: Mapping[str, memoryview], scratch: Callable[[int], memoryview]) -> AnimationFile | None:
    """The model of an upload that has been read before.

    None where clips of its kind are GLB, and of a mesh and its motion in a file each.
    """
    try:
        name = find_main_part(views)
    except InvalidModel:
        return None
    data = views[name]
    known = _format(data[:SIGNATURE_BYTES])
    if known.name == "zip":
        return _open_model_in_zip(name, data, scratch)
    return (
        AnimationFile(known, name, data, {other: views[other] for other in views if other != name})
        if known.clips
        else None
    )


def _open_model_in_zip(name: str, data: memoryview, scratch: Callable[[int], memoryview]) -> AnimationFile | None:
    files = ZipMembers(cast("BinaryIO", BufferFile(data)), Limits.none())
    inner = None if files.are_arrays() else files.model()
    if inner is None:
        return AnimationFile(INPUT_FORMATS["npz" if files.are_arrays() else "zip"], name, data, {})
    with files.inflate(inner) as file:
        known = _format(file.read(SIGNATURE_BYTES))
    if not known.clips:
        return None
    beside = {called: read_member(files, other, data, scratch) for called, other in files.beside(inner).items()}
    return AnimationFile(known, inner, read_member(files, inner, data, scratch), beside)


def _format(head: bytes | memoryview) -> InputFormat:
    return INPUT_FORMATS[detect_file_type(bytes(head))]
