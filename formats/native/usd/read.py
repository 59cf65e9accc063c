"""A USD as an animation: as glTF where that can hold it, else by its vertices."""

from collections.abc import Callable
from dataclasses import replace

from caesura.core.animation import Animation
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.gltf.read import read_gltf
from caesura.formats.native.read_as_gltf import receive_glb
from caesura.formats.native.read_as_vertices import receive_vertices
from caesura.formats.native.reader_process import NativeReader, ReaderProcess
from caesura.formats.native.usd.usdz import first_layer

USD = NativeReader("USD", "pxr", "caesura.formats.native.usd.read_in_child:read_stage", extra="usd")


def read_usd(
    data: memoryview, parameters: Parameters, limits: Limits, scratch: Callable[[int], memoryview]
) -> Animation:
    """The animation of one layer, in metres and Y up. What it refers to in other files is left out.

    Raises `BrokenContainer` (`malformed-usd`, `malformed-zip`, `reader-crashed`), `InvalidModel`, `LimitExceeded`, or
    `UnsupportedMedia("reader-missing")`.
    """
    with ReaderProcess(USD, first_layer(data, limits), limits) as process:
        said = process.receive()
        if "glb" not in said:
            return receive_vertices(process, said, parameters, limits, scratch)
        converted = receive_glb(process, said, limits)
    animation = read_gltf(memoryview(converted.glb), {}, parameters, limits)
    return replace(animation, notices=(*converted.notices, *animation.notices))
