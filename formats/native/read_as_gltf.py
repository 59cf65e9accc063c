"""A file that is read as glTF in a process of its own."""

from typing import Any

from caesura.core.limits import Limits
from caesura.core.segmentation_document import Notice
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.native.reader_main import memory_problem
from caesura.formats.native.reader_process import NativeReader, ReaderProcess


def read_as_glb(reader: NativeReader, data: memoryview, limits: Limits) -> GltfConversion:
    """The GLB of a file, and what its reader noted; raises as `ReaderProcess` does."""
    with ReaderProcess(reader, data, limits) as process:
        return receive_glb(process, process.receive(), limits)


def receive_glb(process: ReaderProcess, said: dict[str, Any], limits: Limits) -> GltfConversion:
    """The GLB that the process has announced."""
    if said["glb"] > limits.max_reader_bytes:
        raise memory_problem(process.reader.title, limits)
    room = memoryview(bytearray(said["glb"]))
    process.fill(room)
    return GltfConversion(room.toreadonly(), tuple(Notice.model_validate(noted) for noted in said["notices"]))
